/// The contact of a probe that is over the middle of a triangle, as the kernel finds it, without the kernel's
/// search for the edge.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/geometry/point_triangle.h"

namespace touchmark::grid {

/// contact_on(triangle, center, id), bit for bit, for a centre that the plane filter puts inside the prism
/// over the face: by 2 units in the last place of single precision at least, far more than the rounding of
/// the kernel's own three tests, so that they all hold. The triangle's extent squared and squared again must
/// stay within the range of double (DirectGrid::build sees to that).
inline Contact contact_over_face(const PreparedTriangle& triangle, const Vec3& center,
                                 TriangleId id) noexcept {
  const std::array<Vec3, 3> to = {center - triangle.corner[0], center - triangle.corner[1],
                                  center - triangle.corner[2]};
  const std::array<double, 3> squared = {to[0].squaredNorm(), to[1].squaredNorm(), to[2].squaredNorm()};
  std::size_t near = squared[1] < squared[0] ? 1 : 0;
  if (squared[2] < squared[near]) near = 2;
  const double height = to[near].dot(triangle.normal);
  const Vec3 offset = height * triangle.normal;
  const double distance = std::sqrt(height * height);
  if (!(distance > 0)) return contact_on(triangle, center, id);
  return {center - offset, Vec3(offset / distance), distance, id};
}

}  // namespace touchmark::grid
