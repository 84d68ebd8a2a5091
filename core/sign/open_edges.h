/// Finds the edges at which a mesh's surface ends, and those at which its triangles contradict each other
/// about what is outside.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/subdivision/edge_map.h"
#include "core/subdivision/indexed_faces.h"

namespace touchmark::sign {

/// Triangles run along an edge one way or the other. Where as many run each way the edge bounds nothing.
struct OpenEdges {
  /// One more runs this way than back: ends as places in the welded positions.
  std::vector<std::array<std::uint32_t, 2>> edges;
  /// At least two more run one way than the other: on one of them outside is on the wrong side. Every surface
  /// that cannot be oriented has such edges.
  std::size_t contrary = 0;
};

OpenEdges open_edges(const IndexedTriangles& welded, const EdgeMap<3>& edges);

}  // namespace touchmark::sign
