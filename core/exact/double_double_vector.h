/// Vectors of double-doubles: the differences of stored coordinates, which are exact, and their products.
#pragma once

#include <array>

#include "core/exact/double_double.h"
#include "core/probe.h"

namespace touchmark::double_double {

using Vector = std::array<DoubleDouble, 3>;

inline Vector difference(const Vec3& a, const Vec3& b) noexcept {
  return {two_sum(a.x(), -b.x()), two_sum(a.y(), -b.y()), two_sum(a.z(), -b.z())};
}

inline DoubleDouble dot(const Vector& a, const Vector& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector cross(const Vector& a, const Vector& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace touchmark::double_double
