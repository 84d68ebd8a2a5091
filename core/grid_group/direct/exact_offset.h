/// The exact kernel as the direct form calls it: with AVX2 where the processor has it, the same bits without.
#pragma once

#include <array>
#include <cstddef>

#include "core/geometry/point_triangle.h"

namespace touchmark::grid {

/// offset_from(triangle, center).
Offset exact_offset(const PreparedTriangle& triangle, const Vec3& center) noexcept;

/// Returns the same offset for a centre that the plane filter puts inside the prism over the face: it is
/// inside by 2 units in the last place of single precision at least, far more than the rounding of the
/// kernel's own three tests, so they all hold. Fourth powers of the mesh's extent must stay within the range
/// of double.
inline Offset offset_over_face(const PreparedTriangle& triangle, const Vec3& center) noexcept {
  const std::array<Vec3, 3> to = {center - triangle.corner[0], center - triangle.corner[1],
                                  center - triangle.corner[2]};
  const std::array<double, 3> squared = {to[0].squaredNorm(), to[1].squaredNorm(), to[2].squaredNorm()};
  std::size_t near = squared[1] < squared[0] ? 1 : 0;
  if (squared[2] < squared[near]) near = 2;
  const double height = to[near].dot(triangle.normal);
  return {height * triangle.normal, height * height};
}

}  // namespace touchmark::grid
