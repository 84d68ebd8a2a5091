/// The distance from a point to a triangle, without failure on slivers, caps, far offsets or zero area.
///
/// Three choices make it so (max error 16 u M, u = 2^-53, M the largest coordinate difference to the
/// vertices):
/// - Only differences of coordinates enter, so a far offset costs nothing.
/// - The unit face normal is computed once, in double-double, so no query divides by a vanishing area.
/// - The face is used only where the point is inside by more than the rounding of that test. A point that is
///   inside by less is within that rounding of an edge, and the edge's distance is as good; a point outside
///   is never given the (too small) distance to the plane.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// A triangle as the kernel reads it. Built from the mesh's own vertices, bit for bit.
struct PreparedTriangle {
  std::array<Vec3, 3> corner;
  Vec3 normal = Vec3::Zero();  ///< unit, counter-clockwise; zero when the corners are collinear to rounding
  std::uint32_t index = 0;     ///< position in the mesh, the key that ties are broken by
};

PreparedTriangle prepare(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t index) noexcept;
PreparedTriangle prepare(const TriangleMesh& mesh, std::uint32_t triangle) noexcept;
/// All of them, in the mesh's order.
std::vector<PreparedTriangle> prepare(const TriangleMesh& mesh);

/// The square of the distance. Two triangles that share an edge or a vertex give the same bits where that
/// edge or vertex is nearest, so ties are found as equal numbers.
double squared_distance(const PreparedTriangle& triangle, const Vec3& point) noexcept;

/// A candidate for nearest: smaller squared distance first, then lower index. Detectors that look at
/// triangles in any order and keep the least Candidate agree bit for bit.
struct Candidate {
  double squared_distance = std::numeric_limits<double>::infinity();
  std::uint32_t index = std::numeric_limits<std::uint32_t>::max();

  bool operator<(const Candidate& other) const noexcept {
    return squared_distance < other.squared_distance ||
           (squared_distance == other.squared_distance && index < other.index);
  }
};

/// The contact on this triangle: `distance` is the square root of squared_distance(triangle, point).
Contact contact_on(const PreparedTriangle& triangle, const Vec3& point, TriangleId id) noexcept;

/// By how much squared_distance can fall short of the true square, and a bounding volume's own rounded
/// distance exceed its true one, anywhere in a query whose coordinates differ by at most
/// `largest_difference`: a volume may be skipped only if its distance minus this exceeds the best distance so
/// far.
inline double culling_slack(double largest_difference) noexcept {
  return 64 * (std::numeric_limits<double>::epsilon() / 2) * largest_difference;
}

}  // namespace touchmark
