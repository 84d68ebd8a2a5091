#include "core/search/closest_candidates.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/search/nearest_of_ties.h"
#include "core/search/shared_feature.h"

namespace touchmark {

/// Of more than there is room for only the exactly nearest is remembered, the first where several are.
void NearestSoFar::make_room() noexcept {
  if (closeness_ == 0) {
    rival_count_ = 0;
    return;
  }
  NearestOfTies ties(*center_);
  show(ties);
  exact_decisions_ += static_cast<std::uint32_t>(ties.exact_decisions());
  const auto is_nearest = [&](const Rival& rival) { return &triangles_[rival.at] == ties.nearest(); };
  const auto nearest = std::find_if(rivals_.begin(), rivals_.end(), is_nearest);
  rival_count_ = nearest == rivals_.end() ? 0 : 1;
  if (rival_count_ == 1) rivals_[0] = *nearest;
}

/// The rival first that was the nearest when there was no more room.
void NearestSoFar::show(NearestOfTies& ties) const noexcept {
  for (const Rival& rival : std::span(rivals_).first(rival_count_)) ties.consider(triangles_[rival.at]);
  if (found()) ties.consider(triangles_[at_]);
}

bool NearestSoFar::beats_rivals(double error) const noexcept {
  const PreparedTriangle& first = triangles_[at_];
  const double limit = std::sqrt(best_.squared_distance) + error;
  for (const Rival& rival : std::span(rivals_).first(rival_count_)) {
    if (rival.squared_distance == best_.squared_distance) {
      // The first of the two was kept: that is right if their distances are equal.
      if (!surely_share_nearest(first, triangles_[rival.at], *center_)) return false;
    } else if (std::sqrt(rival.squared_distance) <= limit) {
      return false;
    }
  }
  return true;
}

}  // namespace touchmark
