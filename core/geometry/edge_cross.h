/// The cross product of two edges of a triangle in double-double: all of a thin triangle's normal lies in
/// what doubles round away.
#pragma once

#include "core/exact/double_double_vector.h"
#include "core/probe.h"
#include "core/simd/target.h"

#if TOUCHMARK_HAS_AVX2
#include <array>

#include <immintrin.h>
#endif

namespace touchmark {

/// Returns (b - a) x (c - a), rounded at the end.
inline Vec3 edge_cross(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const double_double::Vector cross =
      double_double::cross(double_double::difference(b, a), double_double::difference(c, a));
  return {cross[0].rounded(), cross[1].rounded(), cross[2].rounded()};
}

}  // namespace touchmark

#if TOUCHMARK_HAS_AVX2
TOUCHMARK_TARGET("avx2")
namespace touchmark {
namespace avx2 {

/// Four double-doubles. The operations are those of core/exact/double_double.h in their order, for the same
/// bits.
struct DoubleDoubles {
  __m256d high, low;
};

inline DoubleDoubles two_sums(__m256d a, __m256d b) noexcept {
  const __m256d sum = a + b;
  const __m256d b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

inline DoubleDoubles in_halves(__m256d x) noexcept {
  const __m256d scaled = _mm256_set1_pd(134217729.0) * x;  // 2^27 + 1
  const __m256d high = scaled - (scaled - x);
  return {high, x - high};
}

inline DoubleDoubles two_products(__m256d a, __m256d b) noexcept {
  const __m256d product = a * b;
  const DoubleDoubles x = in_halves(a), y = in_halves(b);
  return {product, ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

inline DoubleDoubles minus(const DoubleDoubles& a, const DoubleDoubles& b) noexcept {
  const DoubleDoubles high = two_sums(a.high, -b.high);
  const DoubleDoubles low = two_sums(a.low, -b.low);
  const DoubleDoubles middle = two_sums(high.high, high.low + low.high);
  return two_sums(middle.high, middle.low + low.low);
}

inline DoubleDoubles times(const DoubleDoubles& a, const DoubleDoubles& b) noexcept {
  const DoubleDoubles product = two_products(a.high, b.high);
  return two_sums(product.high, product.low + (a.high * b.low + a.low * b.high));
}

/// x, y and z in lanes of their own; the last one is idle.
inline __m256d axes_of(const Vec3& v) noexcept { return _mm256_set_pd(0, v.z(), v.y(), v.x()); }
/// Each axis gets the value of the next.
inline DoubleDoubles next_axes(const DoubleDoubles& v) noexcept {
  constexpr int order = 0b11001001;
  return {_mm256_permute4x64_pd(v.high, order), _mm256_permute4x64_pd(v.low, order)};
}

/// Returns edge_cross(a, b, c), bit for bit.
inline Vec3 edge_cross(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const __m256d from = -axes_of(a);
  const DoubleDoubles e = two_sums(axes_of(b), from), f = two_sums(axes_of(c), from);
  const DoubleDoubles e1 = next_axes(e), f1 = next_axes(f);
  const DoubleDoubles cross = minus(times(e1, next_axes(f1)), times(next_axes(e1), f1));
  alignas(32) std::array<double, 4> rounded;
  _mm256_store_pd(rounded.data(), cross.high + cross.low);
  return {rounded[0], rounded[1], rounded[2]};
}

}  // namespace avx2
}  // namespace touchmark
TOUCHMARK_END_TARGET
#endif
