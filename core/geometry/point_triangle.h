/// The distance from a point to a triangle, without failure on slivers, caps, far offsets or zero area.
///
/// It is at most 48 u M too long and 15 u M too short, u = 2^-53, M the largest coordinate difference to the
/// vertices: docs/exactness.md, E1. Only differences of coordinates enter, the unit normal is computed once
/// in double-double, and the face is used only where the point is inside by more than the rounding of that
/// test. The bound holds for 2^-132 <= M <= 2^232 (E9).
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
/// Prepares all triangles, in the mesh's order.
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

/// The least Candidate of these triangles, in any order, and whose it is; null where there are none.
struct NearestAsComputed {
  const PreparedTriangle* triangle = nullptr;
  Candidate candidate;
};
NearestAsComputed nearest_as_computed(std::span<const PreparedTriangle> triangles,
                                      const Vec3& point) noexcept;

/// Returns the triangle in another unit. `scale` is a power of two, so that nothing rounds.
PreparedTriangle scaled(const PreparedTriangle& triangle, double scale) noexcept;

/// The vector from a triangle's nearest point to the query point, and its squared length.
template <class Scalar>
struct OffsetIn {
  Eigen::Matrix<Scalar, 3, 1> vector;
  Scalar squared;
};
using Offset = OffsetIn<double>;

/// `squared` is squared_distance(triangle, point).
Offset offset_from(const PreparedTriangle& triangle, const Vec3& point) noexcept;

/// The contact on this triangle: `distance` is the square root of squared_distance(triangle, point).
Contact contact_on(const PreparedTriangle& triangle, const Vec3& point, TriangleId id) noexcept;
/// The contact on this triangle where offset_from(triangle, point) is known.
Contact contact_at(const PreparedTriangle& triangle, const Vec3& point, const Offset& offset,
                   TriangleId id) noexcept;

/// A unit vector for the normal of a contact at distance zero: the face's, or any across a collinear one.
Vec3 face_normal(const PreparedTriangle& triangle) noexcept;

/// By how much squared_distance can fall short of the true square, and a bounding volume's own rounded
/// distance exceed its true one, anywhere in a query whose coordinates differ by at most
/// `largest_difference`: a volume may be skipped only if its distance minus this exceeds the best distance so
/// far. Twice kernel_relative_error and more: a sweep's touch is decided within that error on top.
inline double culling_pad(double largest_difference) noexcept {
  return 128 * (std::numeric_limits<double>::epsilon() / 2) * largest_difference;
}

/// Returns true if the mesh has the triangle's corners elsewhere now. Compares bits: -0 is not 0.
bool has_moved(const PreparedTriangle& triangle, const TriangleMesh& mesh) noexcept;

}  // namespace touchmark
