/// Finds where a moving ball first comes near a box: the culling test of every first_hit.
#pragma once

#include <algorithm>
#include <limits>

#include "core/aabb.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/probe.h"

namespace touchmark {

/// How far from the path, anywhere up to the fraction that sweep_hit tells, a triangle that it finds can be,
/// with room for the test of a bounding volume. `largest_difference` M bounds the coordinate differences
/// between the path's ends and the mesh.
///
/// The path's start is within M of a triangle's corners and the path's own coordinates within 2 M, so S is at
/// most 3 M. At its fraction a touched triangle is no farther than the radius and max_early_gap, 1152 u M;
/// the path is real here, not rounded. `enters` below rounds two differences of at most M and M + the
/// widening, the path's coordinate and two quotients: with a radius below 4 M as if the box were 26 u M off;
/// with a larger one every box is met, whatever rounds. In single precision's frame both ends and the boxes'
/// corners are rounded once more, 6 u M. A distance of a sphere's centre to the path is off by less than 40 u
/// M. In all less than 1280 u M.
inline double padded_sweep_radius(const Sweep& sweep, double largest_difference) noexcept {
  return sweep.radius + 1280 * (std::numeric_limits<double>::epsilon() / 2) * largest_difference;
}

/// The fraction at which the centre enters the box widened on every side, or infinity when it does not before
/// `limit`. The corners of the widened box are farther than the ball reaches: a bound, not a touch. A NaN
/// passes.
inline double enters(const Aabb& box, const Sweep& sweep, double pad, double limit) noexcept {
  constexpr double never = std::numeric_limits<double>::infinity();
  double enter = 0, leave = limit;
  for (int k = 0; k < 3; ++k) {
    if (box.min[k] > box.max[k])
      return never;  // an empty box, which an infinite widening would not leave empty
    const double path = sweep.to[k] - sweep.from[k];
    const double low = (box.min[k] - sweep.from[k]) - pad, high = (box.max[k] - sweep.from[k]) + pad;
    if (path == 0) {
      if (low > 0 || high < 0) return never;
      continue;
    }
    enter = std::max(enter, std::min(low / path, high / path));
    leave = std::min(leave, std::max(low / path, high / path));
  }
  return enter > leave ? never : enter;
}

}  // namespace touchmark
