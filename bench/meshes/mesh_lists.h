/// A mesh as the lists of raw_lists.h, from one process to another.
#pragma once

#include <cstdio>
#include <utility>
#include <vector>

#include "bench/support/files/raw_lists.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::meshes {

inline void put_mesh(std::FILE* to, const TriangleMesh& mesh) {
  support::put_number(to, mesh.vertices().size());
  for (const Vec3& vertex : mesh.vertices()) std::fwrite(vertex.data(), sizeof(double), 3, to);
  support::put_list(to, mesh.triangles());
  support::put_list(to, mesh.ids());
}

/// Throws MeshError where it ends too early.
inline TriangleMesh take_mesh(std::FILE* from) {
  std::vector<Vec3> vertices(support::take_number(from));
  for (Vec3& vertex : vertices)
    if (std::fread(vertex.data(), sizeof(double), 3, from) != 3) throw MeshError("a mesh ends too early");
  auto triangles = support::take_list<TriangleMesh::Corners>(from);
  auto ids = support::take_list<TriangleId>(from);
  return {std::move(vertices), std::move(triangles), std::move(ids)};
}

}  // namespace touchmark::bench::meshes
