/// Triangles that are as far from a point but for rounding: where a detector that compares computed distances
/// names the wrong one.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "bench/experiments/stress/corner_cases.h"
#include "bench/oracle/oracle.h"
#include "core/float_limits.h"

namespace touchmark::bench::experiments::stress {

/// Triangles and their images turned about the diagonal x = y = z, exactly as far from each point of it: the
/// coordinates of the one are those of the other in turn, so that their squares are added in another order.
/// Some are then nearer or farther by a few units in the last place.
inline TriangleMesh turned_images(CornerCases& cases, std::size_t count) {
  std::vector<CornerCases::Corners> triangles;
  for (std::size_t i = 0; i < count; ++i) {
    CornerCases::Corners corners = i % 4 == 0 ? cases.needle() : cases.plain();
    const Vec3 position = cases.magnitude(0, 1.5) * cases.vector();
    for (Vec3& corner : corners) corner += position;
    for (int turn = 0; turn < 3; ++turn) {
      CornerCases::Corners image = corners;
      double& one = image[cases.below(3)][static_cast<int>(cases.below(3))];
      for (std::size_t ulps = cases.below(3); ulps > 0; --ulps)
        one = std::nextafter(one, cases.below(2) == 0 ? infinity : -infinity);
      triangles.push_back(image);
      for (Vec3& corner : corners) corner = Vec3(corner.y(), corner.z(), corner.x());
    }
  }
  for (std::size_t i = triangles.size(); i > 1; --i) std::swap(triangles[i - 1], triangles[cases.below(i)]);
  return mesh_of(triangles);
}

/// On the diagonal, the size of such a mesh or some times that away.
inline Vec3 on_the_diagonal(CornerCases& cases) {
  return Vec3::Constant(cases.magnitude(0, 4) * cases.vector().x());
}

/// On the way from one point to another where another triangle becomes the nearest, to the last bit: beside
/// the bisector of two triangles, or over the border between the corner, the edge and the face of one. The
/// end where none does.
inline Vec3 where_the_nearest_changes(const oracle::Oracle& oracle, Vec3 from, Vec3 to) {
  const std::uint32_t first = oracle.solve(from).triangle;
  for (;;) {
    const Vec3 middle = 0.5 * from + 0.5 * to;
    if (middle == from || middle == to) return to;
    (oracle.solve(middle).triangle == first ? from : to) = middle;
  }
}

/// It and some doubles beside it.
inline std::vector<Vec3> with_neighbors(const Vec3& position, CornerCases& cases) {
  std::vector<Vec3> positions(8, position);
  for (std::size_t i = 1; i < positions.size(); ++i)
    for (double& x : positions[i])
      for (std::size_t ulps = cases.below(3), down = cases.below(2); ulps > 0; --ulps)
        x = std::nextafter(x, down == 0 ? infinity : -infinity);
  return positions;
}

}  // namespace touchmark::bench::experiments::stress
