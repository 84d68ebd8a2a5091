#include "core/search/ties/corner_advance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

namespace touchmark {
namespace {

using double_double::difference, double_double::dot, double_double::Vector;

/// Below, u = 2^-53, and v = 2^-103 bounds the relative error of an operation of double-doubles
/// (precise_closest_point.cpp). Differences of coordinates are exact in double-doubles.
constexpr double relative_error = 0x1p-49;  // 16 u

/// Lengths below this may lose bits in their products' lower halves. Above it those losses, some 2^-1074, are
/// far below the errors stated, which are more than 2^-400.
constexpr double min_length = 0x1p-130;
constexpr double max_length = 0x1p160;

bool fits(double length) noexcept { return length >= min_length && length <= max_length; }

/// Is the one zero in each coordinate where the other is not?
bool are_across(const Vector& a, const Vector& b) noexcept {
  return (a[0].high == 0 || b[0].high == 0) && (a[1].high == 0 || b[1].high == 0) &&
         (a[2].high == 0 || b[2].high == 0);
}

Vec3 rounded(const Vector& v) noexcept { return {v[0].high, v[1].high, v[2].high}; }

}  // namespace

BesideCorner::BesideCorner(const TriangleCorners& nearest, const Vec3& point) noexcept {
  std::size_t corner = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if ((point - nearest[i]).squaredNorm() < (point - nearest[corner]).squaredNorm()) corner = i;
  corner_ = nearest[corner];
  offset_ = difference(point, corner_);
  length_ = rounded(offset_).norm();
  own_ = advance(nearest, corner);
}

std::partial_ordering BesideCorner::compare(const TriangleCorners& triangle) const noexcept {
  const auto found = std::find(triangle.begin(), triangle.end(), corner_);
  if (found == triangle.end()) return std::partial_ordering::unordered;
  const Advance other = advance(triangle, static_cast<std::size_t>(found - triangle.begin()));
  if (other.upper < own_.lower) return std::partial_ordering::greater;
  if (other.lower > own_.upper) return std::partial_ordering::less;
  const bool both_at_corner = other.upper == 0 && own_.upper == 0;
  return both_at_corner ? std::partial_ordering::equivalent : std::partial_ordering::unordered;
}

// The bounds of s: docs/exactness.md, E6, step 4. The product of double-doubles is off by less than 5 v |v|
// |e|, so t = v.e / |e| by 2^-100 |v| and, for the norms and the quotient, 8 u of itself: there is room
// twice.
BesideCorner::Advance BesideCorner::advance(const TriangleCorners& triangle,
                                            std::size_t corner) const noexcept {
  const std::array<Vector, 2> edge = {difference(triangle[(corner + 1) % 3], corner_),
                                      difference(triangle[(corner + 2) % 3], corner_)};
  const Vec3 first = rounded(edge[0]), second = rounded(edge[1]);
  const std::array<double, 2> length = {first.norm(), second.norm()};
  if (!fits(length_) || !fits(length[0]) || !fits(length[1])) return {};
  std::array<double, 2> lower, upper;
  Advance result;
  for (std::size_t i = 0; i < 2; ++i) {
    const double along = dot(offset_, edge[i]).high / length[i];
    const double error =
        are_across(offset_, edge[i]) ? 0 : 0x1p-99 * length_ + relative_error * std::abs(along);
    lower[i] = along - error;
    upper[i] = along + error;
    if (upper[i] < length[i] * (1 - relative_error)) result.lower = std::max(result.lower, lower[i]);
  }
  if (upper[0] <= 0 && upper[1] <= 0) return {0, 0};
  const double cosine = first.dot(second) / (length[0] * length[1]) - 2 * relative_error;  // or a little more
  const auto is_on = [&](std::size_t i) {
    const double across = cosine >= 0 ? lower[i] * cosine : upper[i] * cosine;
    return lower[i] > 0 && upper[1 - i] <= across;
  };
  if (is_on(0)) {
    result.upper = upper[0];
  } else if (is_on(1)) {
    result.upper = upper[1];
  } else if (cosine >= 0) {
    const double half = std::sqrt((1 + cosine) / 2);
    result.upper = std::max({upper[0], upper[1], 0.0}) / half * (1 + relative_error);
  }
  return result;
}

}  // namespace touchmark
