/// The roundings that culling by spheres must leave room for, so that no triangle is lost by an ulp.
#pragma once

#include <limits>

#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/sphere_cluster/sphere_radius.h"

namespace touchmark {

/// Below this, squares of lengths underflow and the kernel's distances stop being relative.
inline constexpr double smallest_length = 1e-150;

/// A sphere can hold a triangle whose computed distance is at most `reach` only if the square of the distance
/// to its centre is at most the square of this: docs/exactness.md, E12.
inline double grown_radius(double radius, double reach) noexcept {
  constexpr double factor = 1 + 512 * (std::numeric_limits<double>::epsilon() / 2);
  return (radius + reach) * factor + smallest_length;
}

/// What the fast level's touch of a sphere may be farther away than the probe's radius and than grown_radius
/// leaves room for: roundings of the largest difference between the path and a sphere near it, which is at
/// most the coordinates of both ends and the sphere, and of a position on the path.
inline double sweep_pad(const Sweep& sweep) noexcept {
  return 128 * std::numeric_limits<double>::epsilon() *
         (sweep.from.lpNorm<Eigen::Infinity>() + sweep.to.lpNorm<Eigen::Infinity>());
}

}  // namespace touchmark
