#include "core/scene/body_sweep.h"

#include <algorithm>
#include <limits>

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

Around around_way(const Sweep& sweep, double error) noexcept {
  const Vec3 middle = sweep.from + 0.5 * (sweep.to - sweep.from);
  const double farther = std::max(path_length(sweep.from, middle), path_length(middle, sweep.to));
  return {middle, (sweep.radius + farther + error) * (1 + 4 * std::numeric_limits<double>::epsilon())};
}

double path_length(const Vec3& from, const Vec3& to) noexcept {
  return (to - from).norm() * (1 + 4 * std::numeric_limits<double>::epsilon());
}

}  // namespace touchmark
