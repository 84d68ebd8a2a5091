/// The triangles around a point, where a caller keeps them for the next ticks: a scene, of all its bodies.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "core/detector.h"
#include "core/geometry/point_triangle.h"

namespace touchmark {

/// In no order, none twice. Triangle i is at least bound[i] + (x[i], y[i], z[i]) . d from where is d away
/// from the centre, but for the error and 2^-20 of what that is and of d; (x, y, z) is a unit vector, or 0.
struct ListedTriangles {
  static constexpr std::uint32_t capacity = 128;

  std::array<const PreparedTriangle*, capacity> triangle;  ///< as long as the detector is as it was
  std::array<float, capacity> bound, x, y, z;              ///< mesh units
  std::uint32_t count = 0;
  double covered = 0;  ///< no triangle that is not listed is nearer to the centre
  double error = 0;    ///< mesh units
};

/// `list_triangles` lists all triangles within a ball, and perhaps some more. Returns false where there are
/// too many, or where it cannot say so.
template <class D>
concept ListsTriangles = requires(const D& detector, const Vec3& center, double radius,
                                  typename D::Session& session, ListedTriangles& into) {
  { detector.list_triangles(center, radius, session, into) }
  noexcept->std::same_as<bool>;
};

}  // namespace touchmark
