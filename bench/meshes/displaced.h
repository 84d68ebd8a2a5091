/// Moves some vertices of a mesh a little: what an updated detector is built of before it follows its mesh.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "bench/support/random.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::meshes {

/// Vertices in the lower half of the box's longest side go towards its middle, each by another part of the
/// way, a tenth at most: the others stay, and so does the mesh's place and size, but for an eighth. What a
/// hierarchy follows is then followed, not built anew; and no number leaves the range of double.
inline TriangleMesh displaced(const TriangleMesh& mesh, std::uint64_t seed) {
  support::Random random(seed);
  const Aabb& box = mesh.bounds();
  const Vec3 middle = 0.5 * box.min + 0.5 * box.max;
  int longest = 0;
  (0.5 * box.max - 0.5 * box.min).maxCoeff(&longest);
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (Vec3& v : vertices) {
    const double part = 0.1 * random.unit();
    if (v[longest] < middle[longest]) v = (1 - part) * v + part * middle;
  }
  return {std::move(vertices),
          {mesh.triangles().begin(), mesh.triangles().end()},
          {mesh.ids().begin(), mesh.ids().end()}};
}

}  // namespace touchmark::bench::meshes
