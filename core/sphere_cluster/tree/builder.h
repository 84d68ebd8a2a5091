/// Builds the hierarchy top-down: ranges of triangles are split where it is expected to cost least, eight
/// ranges make a node, up to eight triangles a block.
#pragma once

#include "core/search/plane_filter.h"
#include "core/sphere_cluster/clustering.h"
#include "core/sphere_cluster/tree/node.h"
#include "core/triangle_mesh.h"

namespace touchmark::spheres {

/// Triangles of a cluster stay together until everything else has been split. The frame must fit the mesh.
/// Returns the same bits with any number of threads.
TreeParts build_tree(const TriangleMesh& mesh, const SphereClusters& clusters, const FilterFrame& frame,
                     unsigned threads);

}  // namespace touchmark::spheres
