/// What a scene asks a detector about the triangles around a point: those that may be nearest, where the
/// images of a body's triangles decide which is; those within a ball, to be kept for the next ticks; and how
/// far the mesh surely is.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "core/detector.h"
#include "core/geometry/point_triangle.h"

namespace touchmark {

/// In no order, perhaps one twice.
struct CloseTriangles {
  std::array<std::uint32_t, 16> triangle;  ///< places in the mesh
  std::size_t count = 0;
  double least = 0;  ///< the least distance, as computed
  double error = 0;  ///< bounds how far any of theirs may be off
};

/// `close_triangles` tells all triangles whose distance is at most the reach and exceeds the least one by at
/// most the slack, and perhaps some more; none where all are farther than the reach. Returns false where it
/// cannot say so. It costs what `nearest` does without the contact.
template <class D>
concept TellsCloseTriangles = requires(const D& detector, const Vec3& center, double reach, double slack,
                                       typename D::Session& session, CloseTriangles& into) {
  { detector.close_triangles(center, reach, slack, session, into) }
  noexcept->std::same_as<bool>;
};

/// `clearance` bounds the distance from a point to the mesh from below, by what the session remembers: a few
/// operations.
template <class D>
concept TellsClearance = requires(const D& detector, const Vec3& center, const typename D::Session& session) {
  { detector.clearance(center, session) }
  noexcept->std::same_as<double>;
};

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
