/// offset_from by the widest instructions that the processor has, with the same bits.
#pragma once

#include "core/geometry/point_triangle.h"

namespace touchmark {

/// Returns offset_from(triangle, point). A call of its own: loops over triangles that are compiled for AVX2
/// call avx2::offset_from themselves.
Offset widest_offset_from(const PreparedTriangle& triangle, const Vec3& point) noexcept;

}  // namespace touchmark
