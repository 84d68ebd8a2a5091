/// Radii rounded so that spheres keep holding what they should.
#pragma once

#include <cmath>
#include <limits>

#include "core/geometry/smallest_sphere.h"
#include "core/probe.h"

namespace touchmark {

/// |v| without overflow or underflow of the squares, within 8 roundings.
inline double safe_norm(const Vec3& v) noexcept {
  constexpr double min_squared = 0x1p-900, max_squared = 0x1p900;
  const double squared = v.squaredNorm();
  if (squared > min_squared && squared < max_squared) return std::sqrt(squared);
  const double largest = v.cwiseAbs().maxCoeff();
  return largest > 0 ? largest * (v / largest).norm() : 0.0;
}

/// The distance between two points, rounded up: a sphere about one with this radius holds the other.
inline double radius_to(const Vec3& center, const Vec3& point) noexcept {
  constexpr double relative_error = 16 * (std::numeric_limits<double>::epsilon() / 2);
  return safe_norm(point - center) * (1 + relative_error);
}

}  // namespace touchmark
