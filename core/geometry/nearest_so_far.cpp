#include "core/geometry/nearest_so_far.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/shared_feature.h"

namespace touchmark {

/// What came more than once needs to be known once; of more than that the last are forgotten.
void NearestSoFar::make_room() noexcept {
  const auto begin = rivals_.begin(), end = rivals_.end();
  std::sort(begin, end, [](const Rival& a, const Rival& b) { return a.at < b.at; });
  const auto last = std::unique(begin, end, [](const Rival& a, const Rival& b) { return a.at == b.at; });
  rival_count_ = static_cast<std::uint32_t>(last - begin);
  if (rival_count_ < most_rivals) return;
  too_many_ = true;
  --rival_count_;
}

bool NearestSoFar::beats_rivals(std::span<const PreparedTriangle> triangles, const Vec3& center,
                                double error) const noexcept {
  if (too_many_) return false;
  const PreparedTriangle& first = triangles[at_];
  const double limit = std::sqrt(best_.squared_distance) + error;
  for (const Rival& rival : std::span(rivals_).first(rival_count_)) {
    if (rival.squared_distance == best_.squared_distance) {
      // The first of the two was kept: that is right if their distances are equal.
      if (!surely_share_nearest(first, triangles[rival.at], center)) return false;
    } else if (std::sqrt(rival.squared_distance) <= limit) {
      return false;
    }
  }
  return true;
}

}  // namespace touchmark
