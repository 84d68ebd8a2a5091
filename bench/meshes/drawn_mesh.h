/// A mesh made coarse enough to be drawn on a page. Nothing is measured or judged on it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace touchmark::bench::meshes {

struct DrawnMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// At most about so many triangles: the mesh itself where it has no more, else its vertices by cells of a
/// grid, each cell's at their mean (Rossignac & Borrel 1993).
DrawnMesh drawn_mesh(const TriangleMesh& mesh, std::size_t max_triangles);

}  // namespace touchmark::bench::meshes
