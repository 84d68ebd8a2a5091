/// The cross product of two edges of a triangle in double-double: all of a thin triangle's normal lies in what
/// doubles round away.
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

inline DoubleDoubles two_products(__m256d a, __m256d b) noexcept {
  const __m256d splitter = _mm256_set1_pd(134217729.0);  // 2^27 + 1
  const auto split = [&](__m256d x) {
    const __m256d scaled = splitter * x;
    const __m256d high = scaled - (scaled - x);
    return DoubleDoubles{high, x - high};
  };
  const __m256d product = a * b;
  const DoubleDoubles x = split(a), y = split(b);
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

/// Returns edge_cross(a, b, c), bit for bit: an axis in each lane, and an idle one.
inline Vec3 edge_cross(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const auto axes = [](const Vec3& v) { return _mm256_set_pd(0, v.z(), v.y(), v.x()); };
  const __m256d from = -axes(a);
  const DoubleDoubles e = two_sums(axes(b), from), f = two_sums(axes(c), from);
  const auto next = [](__m256d v) { return _mm256_permute4x64_pd(v, 0b11001001); };
  const DoubleDoubles e1{next(e.high), next(e.low)}, f1{next(f.high), next(f.low)};
  const DoubleDoubles e2{next(e1.high), next(e1.low)}, f2{next(f1.high), next(f1.low)};
  const DoubleDoubles cross = minus(times(e1, f2), times(e2, f1));
  alignas(32) std::array<double, 4> rounded;
  _mm256_store_pd(rounded.data(), cross.high + cross.low);
  return {rounded[0], rounded[1], rounded[2]};
}

}  // namespace avx2
}  // namespace touchmark
TOUCHMARK_END_TARGET
#endif
