/// Moves the hierarchy with its triangles: who is whose child stays as it was, the bounds follow.
#pragma once

#include <cstddef>
#include <vector>

#include "core/aabb.h"
#include "core/bvh/node.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/triangle_mesh.h"

namespace touchmark::bvh {

/// What was moved, and from where to where: each box holds some triangles as they were and as they are.
struct MovedTriangles {
  std::size_t count = 0;
  std::vector<Aabb> boxes;
};

/// The mesh has the same triangles as the one that the tree was built of, and its box is within the frame's.
/// Bounds are as tight as those of a tree that is built.
MovedTriangles refit_tree(Parts& parts, const TriangleMesh& mesh, const FilterFrame& frame);

}  // namespace touchmark::bvh
