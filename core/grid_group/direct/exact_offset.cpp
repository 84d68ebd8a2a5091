#include "core/grid_group/direct/exact_offset.h"

#include "core/geometry/point_triangle_avx2.h"
#include "core/simd/dispatch.h"  // IWYU pragma: keep

namespace touchmark::grid {

#if TOUCHMARK_HAS_AVX2
namespace {

const bool use_avx2 = widest_simd() >= Simd::avx2;

[[gnu::target("avx2")]] Offset with_avx2(const PreparedTriangle& triangle, const Vec3& center) noexcept {
  return avx2::offset_from(triangle, center);
}

}  // namespace
#endif

Offset exact_offset(const PreparedTriangle& triangle, const Vec3& center) noexcept {
#if TOUCHMARK_HAS_AVX2
  if (use_avx2) return with_avx2(triangle, center);
#endif
  return offset_from(triangle, center);
}

}  // namespace touchmark::grid
