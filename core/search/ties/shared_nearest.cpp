#include "core/search/ties/shared_nearest.h"

#include <algorithm>
#include <cstddef>

#include <Eigen/Geometry>

#include "core/float_limits.h"

namespace touchmark {
namespace {

constexpr std::size_t nowhere = 3;

std::size_t position_of(const Vec3& corner, const std::array<Vec3, 3>& corners) noexcept {
  return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), corner) - corners.begin());
}

/// 1 where corner j comes after i counter-clockwise, -1 where it comes before.
double sense(std::size_t i, std::size_t j) noexcept { return j == (i + 1) % 3 ? 1 : -1; }

bool surely_exceeds(double value, double squared_error) noexcept {
  return value > 0 && value * value > squared_error;
}

/// Corners i and j of a are k and l of b. Is the foot surely on the edge between them, off both triangles?
/// Then the rest of each lies behind the plane through the edge across the way to the point.
bool surely_beside_edge(const PreparedTriangle& a, std::size_t i, std::size_t j, const PreparedTriangle& b,
                        std::size_t k, std::size_t l, const Vec3& point) noexcept {
  const Vec3 edge = a.corner[j] - a.corner[i], to = point - a.corner[i];
  const double edge_squared = edge.squaredNorm(), to_squared = to.squaredNorm();
  // Along the edge: one unit for each of the two differences and three for the products and sums, of
  // |to| |edge| and again of |edge|^2 seen from the other end: 8 u |edge| (|to| + |edge|), squared, is less.
  constexpr double along_relative_error = 8 * unit_roundoff;
  const double along_error =
      2 * along_relative_error * along_relative_error * edge_squared * (to_squared + edge_squared);
  const double along = to.dot(edge);
  if (!surely_exceeds(along, along_error) || !surely_exceeds(edge_squared - along, along_error)) return false;
  // Across it: one unit for each of the two differences, two for the cross product, whose terms' magnitudes
  // come to 1.2 |to| |edge|, three for the normal's components, three for the products and sums.
  constexpr double across_relative_error = 16 * unit_roundoff;
  const double across_error = across_relative_error * across_relative_error * edge_squared * to_squared;
  const Vec3 across = to.cross(edge);
  return surely_exceeds(sense(i, j) * across.dot(a.normal), across_error) &&
         surely_exceeds(sense(k, l) * across.dot(b.normal), across_error);
}

/// Is the point surely behind both edges that begin at the corner? Then no point of the triangle is nearer.
bool surely_off_corner(const PreparedTriangle& t, std::size_t corner, const Vec3& to) noexcept {
  // One unit for each of the two differences, three for the products and sums.
  constexpr double along_relative_error = 8 * unit_roundoff;
  const double to_squared = along_relative_error * along_relative_error * to.squaredNorm();
  for (const std::size_t other : {(corner + 1) % 3, (corner + 2) % 3}) {
    const Vec3 edge = t.corner[other] - t.corner[corner];
    if (!surely_exceeds(-to.dot(edge), to_squared * edge.squaredNorm())) return false;
  }
  return true;
}

bool surely_off_shared_corner(const PreparedTriangle& a, std::size_t i, const PreparedTriangle& b,
                              std::size_t k, const Vec3& point) noexcept {
  const Vec3 to = point - a.corner[i];
  return surely_off_corner(a, i, to) && surely_off_corner(b, k, to);
}

}  // namespace

bool surely_share_nearest(const PreparedTriangle& a, const PreparedTriangle& b, const Vec3& point) noexcept {
  std::array<std::size_t, 3> shared, in_b;  // corner shared[n] of a is in_b[n] of b
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t position = position_of(a.corner[i], b.corner);
    if (position == nowhere) continue;
    shared[count] = i;
    in_b[count++] = position;
  }
  if (count == 3) return have_same_corners(a.corner, b.corner);
  if (count == 2 && surely_beside_edge(a, shared[0], shared[1], b, in_b[0], in_b[1], point)) return true;
  for (std::size_t n = 0; n < count; ++n)
    if (surely_off_shared_corner(a, shared[n], b, in_b[n], point)) return true;
  return false;
}

bool surely_share_corner(const PreparedTriangle& a, const PreparedTriangle& b, const Vec3& point,
                         const Vec3& offset) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    if (point - a.corner[i] != offset) continue;
    const std::size_t position = position_of(a.corner[i], b.corner);
    return position != nowhere && surely_off_shared_corner(a, i, b, position, point);
  }
  return false;
}

bool have_same_corners(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) noexcept {
  const auto all_of_in = [](const std::array<Vec3, 3>& some, const std::array<Vec3, 3>& others) {
    return std::all_of(some.begin(), some.end(),
                       [&](const Vec3& corner) { return position_of(corner, others) != nowhere; });
  };
  return all_of_in(a, b) && all_of_in(b, a);
}

}  // namespace touchmark
