/// The triangles that may be nearest, where a caller decides which is: by the images of a body's triangles.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "core/detector.h"

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

}  // namespace touchmark
