/// Meshes of few triangles that tests of motions share.
#pragma once

#include <utility>

#include "bench/meshes/surface_builder.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::trajectories {

/// A square of edge 1 at z = 0: two triangles and no thickness.
inline TriangleMesh plate() {
  return TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
}

/// Twelve triangles, edges of length 1 along the axes.
inline TriangleMesh cube() {
  meshes::Surface surface;
  meshes::add_box(surface, Vec3::Zero(), Vec3::Ones());
  return std::move(surface).mesh();
}

}  // namespace touchmark::bench::trajectories
