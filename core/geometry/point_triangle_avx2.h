/// offset_from on the three edges at once, for processors with AVX2: about half the time, the same bits.
///
/// Lane i is corner i and the edge from it to the next corner; lane 3 is idle. Every operation is the scalar
/// kernel's, in its order (Eigen sums three products as (x + y) + z), and without fused multiply-adds, which
/// the target leaves out. Where two corners are equally near the scalar kernel breaks the tie; so it does
/// here.
#pragma once

#include "core/geometry/point_triangle.h"
#include "core/simd/target.h"

#if TOUCHMARK_HAS_AVX2
#include <array>
#include <bit>
#include <cstddef>
#include <limits>

#include <immintrin.h>

TOUCHMARK_TARGET("avx2")
namespace touchmark {
namespace avx2 {

using Quad = __m256d;

struct QuadVec {
  Quad x, y, z;
};

inline QuadVec minus(const QuadVec& a, const QuadVec& b) noexcept {
  return {_mm256_sub_pd(a.x, b.x), _mm256_sub_pd(a.y, b.y), _mm256_sub_pd(a.z, b.z)};
}
inline Quad dot(const QuadVec& a, const QuadVec& b) noexcept {
  return _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(a.x, b.x), _mm256_mul_pd(a.y, b.y)),
                       _mm256_mul_pd(a.z, b.z));
}
inline QuadVec cross(const QuadVec& a, const QuadVec& b) noexcept {
  return {_mm256_sub_pd(_mm256_mul_pd(a.y, b.z), _mm256_mul_pd(a.z, b.y)),
          _mm256_sub_pd(_mm256_mul_pd(a.z, b.x), _mm256_mul_pd(a.x, b.z)),
          _mm256_sub_pd(_mm256_mul_pd(a.x, b.y), _mm256_mul_pd(a.y, b.x))};
}
/// Lane i gets lane i + 1's value, of three.
inline Quad next(Quad a) noexcept { return _mm256_permute4x64_pd(a, 0b11001001); }
inline QuadVec next(const QuadVec& a) noexcept { return {next(a.x), next(a.y), next(a.z)}; }
/// b where the mask is set, else a.
inline Quad select(Quad a, Quad b, Quad mask) noexcept { return _mm256_blendv_pd(a, b, mask); }
inline QuadVec select(const QuadVec& a, const QuadVec& b, Quad mask) noexcept {
  return {select(a.x, b.x, mask), select(a.y, b.y, mask), select(a.z, b.z, mask)};
}
inline Quad all(double a) noexcept { return _mm256_set1_pd(a); }

/// The lowest of lanes 0 to 2 that holds the least value. None is NaN.
inline std::size_t index_of_least(Quad a) noexcept {
  const Quad following = next(a);
  const Quad least = _mm256_min_pd(_mm256_min_pd(a, following), next(following));
  const int holders = _mm256_movemask_pd(_mm256_cmp_pd(a, least, _CMP_EQ_OQ));
  return static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(holders)));
}

/// Corner i in lane i.
inline QuadVec corners(const PreparedTriangle& triangle) noexcept {
  const double* const at = triangle.corner[0].data();
  const Quad a = _mm256_loadu_pd(at), b = _mm256_loadu_pd(at + 3), c = _mm256_loadu_pd(at + 6);
  const Quad ab_even = _mm256_unpacklo_pd(a, b), ab_odd = _mm256_unpackhi_pd(a, b);
  const Quad c_swapped = _mm256_permute_pd(c, 0b0101);
  return {_mm256_permute2f128_pd(ab_even, c, 0x20), _mm256_permute2f128_pd(ab_odd, c_swapped, 0x20),
          _mm256_permute2f128_pd(ab_even, c, 0x31)};
}

/// offset_from(triangle, point), bit for bit.
inline Offset offset_from(const PreparedTriangle& triangle, const Vec3& point) noexcept {
  constexpr double relative_error = 8 * (std::numeric_limits<double>::epsilon() / 2);
  const QuadVec corner = corners(triangle);
  const QuadVec to = minus({all(point.x()), all(point.y()), all(point.z())}, corner);
  const Quad squared = dot(to, to);
  const QuadVec edge = minus(next(corner), corner), to_next = next(to);
  const Quad next_squared = next(squared);
  if ((_mm256_movemask_pd(_mm256_cmp_pd(squared, next_squared, _CMP_NEQ_OQ)) & 7) != 7)
    return touchmark::offset_from(triangle, point);
  const Quad from_here = _mm256_cmp_pd(squared, next_squared, _CMP_LT_OQ);
  const QuadVec near = select(to_next, to, from_here);
  const Quad near_squared = select(next_squared, squared, from_here);
  const Quad edge_squared = dot(edge, edge);

  const QuadVec normal = {all(triangle.normal.x()), all(triangle.normal.y()), all(triangle.normal.z())};
  const Quad inside = dot(cross(edge, near), normal);
  const Quad error =
      _mm256_mul_pd(_mm256_mul_pd(all(relative_error * relative_error), near_squared), edge_squared);
  const Quad over_face = _mm256_and_pd(_mm256_cmp_pd(inside, _mm256_setzero_pd(), _CMP_GT_OQ),
                                       _mm256_cmp_pd(_mm256_mul_pd(inside, inside), error, _CMP_GT_OQ));
  if ((_mm256_movemask_pd(over_face) & 7) == 7) {
    alignas(32) std::array<double, 4> heights;
    _mm256_store_pd(heights.data(), dot(to, normal));
    const double height = heights[index_of_least(squared)];
    return {height * triangle.normal, height * height};
  }

  // Along the edge from its nearer end; where that is the far end, the edge is reversed.
  const Quad reversed = _mm256_andnot_pd(from_here, all(-0.0));
  const Quad along = _mm256_xor_pd(dot(near, edge), reversed);
  const Quad part = _mm256_xor_pd(_mm256_min_pd(all(1), _mm256_div_pd(along, edge_squared)), reversed);
  const QuadVec across =
      minus(near, {_mm256_mul_pd(part, edge.x), _mm256_mul_pd(part, edge.y), _mm256_mul_pd(part, edge.z)});
  const Quad across_squared = dot(across, across);
  const Quad on_edge = _mm256_and_pd(_mm256_cmp_pd(along, _mm256_setzero_pd(), _CMP_GT_OQ),
                                     _mm256_cmp_pd(across_squared, near_squared, _CMP_LT_OQ));
  const QuadVec offset = select(near, across, on_edge);
  const Quad least = select(near_squared, across_squared, on_edge);
  const std::size_t best = index_of_least(least);
  alignas(32) std::array<double, 4> s, x, y, z;
  _mm256_store_pd(s.data(), least);
  _mm256_store_pd(x.data(), offset.x);
  _mm256_store_pd(y.data(), offset.y);
  _mm256_store_pd(z.data(), offset.z);
  return {{x[best], y[best], z[best]}, s[best]};
}

}  // namespace avx2
}  // namespace touchmark
TOUCHMARK_END_TARGET
#endif
