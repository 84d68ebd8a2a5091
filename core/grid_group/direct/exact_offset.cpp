#include "core/grid_group/direct/exact_offset.h"

#include "core/geometry/point_triangle_avx2.h"

namespace touchmark::grid {

#if TOUCHMARK_HAS_AVX2
namespace {

const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;

[[gnu::target("avx2")]] Offset with_avx2(const PreparedTriangle& triangle, const Vec3& center) noexcept {
  return avx2::offset_from(triangle, center);
}

}  // namespace
#endif

Offset exact_offset(const PreparedTriangle& triangle, const Vec3& center) noexcept {
#if TOUCHMARK_HAS_AVX2
  if (has_avx2) return with_avx2(triangle, center);
#endif
  return offset_from(triangle, center);
}

}  // namespace touchmark::grid
