#include "core/geometry/point_triangle.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

#include "core/exact/distance_predicates.h"
#include "core/float_limits.h"
#include "core/geometry/edge_cross.h"
#include "core/geometry/point_triangle_kernel.h"
#include "core/simd/dispatch.h"

namespace touchmark {
namespace {

/// Is the point inside the prism over the triangle by more than the rounding of the three tests?
bool surely_over_face(const PreparedTriangle& t, const std::array<Vec3, 3>& to,
                      const std::array<double, 3>& squared) noexcept {
  // (edge x to) . normal is the distance to the edge's line times |edge|. Its rounding: one unit for each of
  // the three inputs, two for the cross product, three for the dot product.
  constexpr double relative_error = 8 * unit_roundoff;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1;
    const Vec3 edge = t.corner[j] - t.corner[i];
    const bool from_i = squared[i] < squared[j];
    const double inside = edge.cross(from_i ? to[i] : to[j]).dot(t.normal);
    const double from_squared = from_i ? squared[i] : squared[j];
    if (!(inside > 0) ||
        !(inside * inside > relative_error * relative_error * from_squared * edge.squaredNorm()))
      return false;
  }
  return true;
}

/// edge_cross by the widest instructions that the processor has.
Vec3 widest_edge_cross(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
#if TOUCHMARK_HAS_AVX2
  if (has_avx2) return avx2::edge_cross(a, b, c);
#endif
  return edge_cross(a, b, c);
}

/// Returns 2^-ilogb(x) for an x that is in range.
double reciprocal_power_of_two(double x) noexcept {
  constexpr std::uint64_t mantissa_bits = 52, twice_bias = 2 * 1023;
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(x) >> mantissa_bits;
  return std::bit_cast<double>((twice_bias - exponent) << mantissa_bits);
}

/// Returns the triangle scaled by a power of two where squares of its sides would leave the range of double.
std::array<Vec3, 3> in_range(const std::array<Vec3, 3>& v) noexcept {
  constexpr double least = 0x1p-400, largest = 0x1p400;
  constexpr int max_exponent = 1000;
  const double extent = std::max({(v[1] - v[0]).cwiseAbs().maxCoeff(), (v[2] - v[1]).cwiseAbs().maxCoeff(),
                                  (v[0] - v[2]).cwiseAbs().maxCoeff()});
  if (extent == 0 || (extent > least && extent < largest)) return v;
  const int exponent =
      std::isinf(extent) ? max_exponent : std::clamp(std::ilogb(extent), -max_exponent, max_exponent);
  const double scale = std::ldexp(1.0, -exponent);
  return {scale * v[0], scale * v[1], scale * v[2]};
}

/// Returns the squares of the sides, each at the corner opposite it.
std::array<double, 3> squared_sides(const std::array<Vec3, 3>& v) noexcept {
  return {(v[2] - v[1]).squaredNorm(), (v[0] - v[2]).squaredNorm(), (v[1] - v[0]).squaredNorm()};
}

std::size_t index_of_longest(const std::array<double, 3>& opposite) noexcept {
  const std::size_t o = opposite[1] > opposite[0] ? 1 : 0;
  return opposite[2] > opposite[o] ? 2 : o;
}

Vec3 unit_normal(const std::array<Vec3, 3>& corner) noexcept {
  std::array<double, 3> opposite = squared_sides(corner);
  // Edges from the corner opposite the longest edge: the best conditioned pair.
  std::size_t o = index_of_longest(opposite);
  const std::array<Vec3, 3>* sides = &corner;
  std::array<Vec3, 3> scaled;
  // Well inside the range of in_range, which leaves these as they are.
  if (!(opposite[o] > 0x1p-780 && opposite[o] < 0x1p780)) {
    scaled = in_range(corner);
    sides = &scaled;
    opposite = squared_sides(scaled);
    o = index_of_longest(opposite);
  }
  const std::array<Vec3, 3>& v = *sides;
  const double longest = std::sqrt(opposite[o]);
  if (!(longest > 0)) return Vec3::Zero();
  // A power of two, so that nothing rounds and no product overflows or vanishes.
  const double scale = reciprocal_power_of_two(longest);
  const Vec3 n =
      widest_edge_cross(scale * v[o], scale * v[o == 2 ? 0 : o + 1], scale * v[o == 0 ? 2 : o - 1]);
  const double length = n.norm();
  // Thinner than a rounding of its length: whatever is over the face is as near to an edge. (length ~ 2
  // area.)
  if (!(length > unit_roundoff)) return Vec3::Zero();
  // As thin as that, the double-doubles' own rounding would show.
  if (length < 0x1p-40) return normal_exactly(corner);
  return n / length;
}

}  // namespace

Vec3 face_normal(const PreparedTriangle& t) noexcept {
  if (!t.normal.isZero(0)) return t.normal;
  const std::array<Vec3, 3> v = in_range(t.corner);
  Vec3 along = v[1] - v[0];
  for (const Vec3& other : {Vec3(v[2] - v[1]), Vec3(v[0] - v[2])})
    if (other.cwiseAbs().maxCoeff() > along.cwiseAbs().maxCoeff()) along = other;
  if (along.isZero(0)) return Vec3::UnitZ();
  return (along / along.cwiseAbs().maxCoeff()).unitOrthogonal();
}

PreparedTriangle prepare(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t index) noexcept {
  PreparedTriangle triangle{{a, b, c}, Vec3::Zero(), index};
  triangle.normal = unit_normal(triangle.corner);
  return triangle;
}

PreparedTriangle prepare(const TriangleMesh& mesh, std::uint32_t triangle) noexcept {
  return prepare(mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2), triangle);
}

std::vector<PreparedTriangle> prepare(const TriangleMesh& mesh) {
  std::vector<PreparedTriangle> prepared;
  prepared.reserve(mesh.size());
  for (std::uint32_t i = 0; i < mesh.size(); ++i) prepared.push_back(prepare(mesh, i));
  return prepared;
}

Offset offset_from(const PreparedTriangle& t, const Vec3& point) noexcept {
  return kernel::offset_from(t, point, surely_over_face);
}

double squared_distance(const PreparedTriangle& triangle, const Vec3& point) noexcept {
  return offset_from(triangle, point).squared;
}

NearestAsComputed nearest_as_computed(std::span<const PreparedTriangle> triangles,
                                      const Vec3& point) noexcept {
  NearestAsComputed nearest;
  for (const PreparedTriangle& triangle : triangles) {
    const Candidate candidate{squared_distance(triangle, point), triangle.index};
    if (candidate < nearest.candidate) nearest = {&triangle, candidate};
  }
  return nearest;
}

PreparedTriangle scaled(const PreparedTriangle& t, double scale) noexcept {
  return {{scale * t.corner[0], scale * t.corner[1], scale * t.corner[2]}, t.normal, t.index};
}

Contact contact_on(const PreparedTriangle& triangle, const Vec3& point, TriangleId id) noexcept {
  return contact_at(triangle, point, offset_from(triangle, point), id);
}

Contact contact_at(const PreparedTriangle& triangle, const Vec3& point, const Offset& offset,
                   TriangleId id) noexcept {
  const double distance = std::sqrt(offset.squared);
  // Below a rounding of the coordinates the offset's direction is noise.
  const bool coincident = !(distance > 0);
  return {point - offset.vector, coincident ? face_normal(triangle) : Vec3(offset.vector / distance),
          distance, id};
}

bool has_moved(const PreparedTriangle& triangle, const TriangleMesh& mesh) noexcept {
  for (int k = 0; k < 3; ++k) {
    const Vec3& corner = triangle.corner[static_cast<std::size_t>(k)];
    if (std::memcmp(corner.data(), mesh.corner(triangle.index, k).data(), 3 * sizeof(double)) != 0)
      return true;
  }
  return false;
}

}  // namespace touchmark
