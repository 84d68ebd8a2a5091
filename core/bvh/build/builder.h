/// Builds the hierarchy top-down: ranges of triangles are split where it is expected to cost least, eight
/// ranges make a node, up to eight triangles a block.
#pragma once

#include "core/bvh/clusters.h"
#include "core/bvh/node.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/triangle_mesh.h"

namespace touchmark::bvh {

/// Triangles of a cluster stay together until everything else has been split; without clusters each is its
/// own one. The frame must fit the mesh. Returns the same bits with any number of threads.
Parts build_tree(const TriangleMesh& mesh, const Clusters* clusters, const FilterFrame& frame,
                 unsigned threads);

}  // namespace touchmark::bvh
