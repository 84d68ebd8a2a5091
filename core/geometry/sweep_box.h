/// Finds where a moving ball first comes near a box, and how near its path comes to a point: the culling
/// tests of every first_hit.
#pragma once

#include <algorithm>
#include <limits>

#include "core/aabb.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/probe.h"

namespace touchmark {

/// How far from the path, anywhere up to the fraction that sweep_hit tells, a triangle that it finds can be,
/// with room for the test of a bounding volume: docs/exactness.md, E18. `largest_difference` M bounds the
/// coordinate differences between the path's ends and the mesh.
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

/// Returns the square of the distance from a point to the path.
inline double squared_distance_to_path(const Sweep& sweep, const Vec3& point) noexcept {
  const Vec3 path = sweep.to - sweep.from, to = point - sweep.from;
  const double along = to.dot(path), squared = path.squaredNorm();
  if (!(along > 0)) return to.squaredNorm();
  return (to - (along < squared ? along / squared : 1.0) * path).squaredNorm();
}

}  // namespace touchmark
