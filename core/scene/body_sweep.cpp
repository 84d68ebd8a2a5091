#include "core/scene/body_sweep.h"

#include <algorithm>
#include <limits>

#include "core/float_limits.h"
#include "core/geometry/sphere_triangle_sweep.h"

namespace touchmark {

Contact contact_on_way(const ImageCandidate& seen_from_start, const Sweep& sweep, double fraction) noexcept {
  const Vec3 way = fraction * (sweep.to - sweep.from);
  TriangleCorners corner = seen_from_start.seen.corner;
  for (Vec3& w : corner) w -= way;
  const PreparedTriangle prepared = prepare(corner[0], corner[1], corner[2], seen_from_start.triangle);
  Contact contact = contact_on(prepared, Vec3::Zero(), seen_from_start.id);
  contact.point += sweep.from + way;
  return contact;
}

std::optional<bool> comes_within_rounded(const ImageCandidate& image, const Vec3& seen_from,
                                         const Sweep& sweep, std::uint64_t& exact_decisions) noexcept {
  const auto& [a, b, c] = image.seen.corner;
  const PreparedTriangle triangle = prepare(a, b, c, image.triangle);
  Sweep seen{sweep.from - seen_from, sweep.to - seen_from, 0};
  const double error =
      image.seen.error + 2 * unit_roundoff * (seen.from.norm() + seen.to.norm() + sweep.radius);
  seen.radius = sweep.radius + error;
  if (!touch_bounds(triangle, seen, 1, exact_decisions)) return false;
  seen.radius = sweep.radius - error;
  if (seen.radius >= 0 && touch_bounds(triangle, seen, 1, exact_decisions)) return true;
  return std::nullopt;
}

Around around_way(const Sweep& sweep, double error) noexcept {
  const Vec3 middle = sweep.from + 0.5 * (sweep.to - sweep.from);
  const double farther = std::max(path_length(sweep.from, middle), path_length(middle, sweep.to));
  return {middle, (sweep.radius + farther + error) * (1 + 4 * std::numeric_limits<double>::epsilon())};
}

double path_length(const Vec3& from, const Vec3& to) noexcept {
  return (to - from).norm() * (1 + 4 * std::numeric_limits<double>::epsilon());
}

}  // namespace touchmark
