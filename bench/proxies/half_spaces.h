/// What constraint-based algorithms solve each tick: the point nearest to the goal behind no plane.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Dense>

#include "bench/proxies/proxy_method.h"

namespace touchmark::bench::proxies {

/// The points x with normal.x >= offset are free.
struct Plane {
  Vec3 normal = Vec3::Zero();  ///< unit
  double offset = 0;

  double height(const Vec3& x) const { return normal.dot(x) - offset; }
};

/// Returns the goal's nearest point on all of one to three planes, and the multipliers that say how hard each
/// one pushes; nothing where the planes are parallel to rounding.
struct OnPlanes {
  Vec3 point;
  Vec3 multipliers;
};
std::optional<OnPlanes> nearest_on(const Vec3& goal, std::span<const Plane> planes);

/// Returns the point nearest to the goal that is behind none of the planes, by trying every set of at most
/// three; `otherwise` where rounding leaves no set.
Vec3 nearest_outside(const Vec3& goal, std::span<const Plane> planes, const Vec3& otherwise);

}  // namespace touchmark::bench::proxies
