/// Where a moving ball first comes near a box: the culling test of every first_hit.
#pragma once

#include <algorithm>
#include <limits>

#include "core/geometry/aabb.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/probe.h"

namespace touchmark {

/// By how much a box must be widened so that no triangle in it that sweep_hit calls touched is missed: the
/// radius, the kernel's slack, and twice the rounding of the position on the way: once for the touch and once
/// for the fraction at which the box is entered. `largest_difference` bounds the coordinate differences
/// between the way and the mesh.
inline double sweep_widening(const Sweep& sweep, double largest_difference) noexcept {
  return sweep.radius + culling_slack(largest_difference) + 2 * position_error(sweep);
}

/// The fraction at which the centre enters the box widened on every side, or infinity when it does not before
/// `limit`. The corners of the widened box are farther than the ball reaches: a bound, not a touch. A NaN
/// passes.
inline double enters(const Aabb& box, const Sweep& sweep, double widening, double limit) noexcept {
  constexpr double never = std::numeric_limits<double>::infinity();
  double enter = 0, leave = limit;
  for (int k = 0; k < 3; ++k) {
    if (box.min[k] > box.max[k])
      return never;  // an empty box, which an infinite widening would not leave empty
    const double way = sweep.to[k] - sweep.from[k];
    const double low = (box.min[k] - sweep.from[k]) - widening,
                 high = (box.max[k] - sweep.from[k]) + widening;
    if (way == 0) {
      if (low > 0 || high < 0) return never;
      continue;
    }
    enter = std::max(enter, std::min(low / way, high / way));
    leave = std::min(leave, std::max(low / way, high / way));
  }
  return enter > leave ? never : enter;
}

}  // namespace touchmark
