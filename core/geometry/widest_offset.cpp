#include "core/geometry/widest_offset.h"

#include "core/geometry/point_triangle_avx2.h"
#include "core/simd/dispatch.h"  // IWYU pragma: keep

namespace touchmark {

#if TOUCHMARK_HAS_AVX2
namespace {

[[gnu::target("avx2")]] Offset with_avx2(const PreparedTriangle& triangle, const Vec3& point) noexcept {
  return avx2::offset_from(triangle, point);
}

}  // namespace
#endif

Offset widest_offset_from(const PreparedTriangle& triangle, const Vec3& point) noexcept {
#if TOUCHMARK_HAS_AVX2
  if (has_avx2) return with_avx2(triangle, point);
#endif
  return offset_from(triangle, point);
}

}  // namespace touchmark
