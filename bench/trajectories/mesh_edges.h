/// The edges of a mesh as a graph to walk on, with the sharp ones marked.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::trajectories {

struct MeshEdge {
  std::uint32_t from, to;  ///< nodes of the graph
  Vec3 bisector;           ///< unit, between the normals of its faces
  bool sharp;              ///< faces meet at more than 30 degrees, or it is a border
};

/// Vertices at the same position are one node, whatever the file calls them. Edges without length are left
/// out, so a mesh that is a single point has none.
class MeshEdges {
 public:
  explicit MeshEdges(const TriangleMesh& mesh);

  std::span<const MeshEdge> edges() const { return edges_; }
  const Vec3& position(std::uint32_t node) const { return nodes_[node]; }
  /// Indices of the edges that end at a node.
  std::span<const std::uint32_t> around(std::uint32_t node) const {
    return std::span(incident_).subspan(first_[node], first_[node + 1] - first_[node]);
  }

 private:
  void link();

  std::vector<Vec3> nodes_;
  std::vector<MeshEdge> edges_;
  std::vector<std::size_t> first_;       ///< one a node and one more: where its edges start in incident_
  std::vector<std::uint32_t> incident_;  ///< edges, by node
};

}  // namespace touchmark::bench::trajectories
