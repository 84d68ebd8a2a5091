/// A mesh's connections by where its vertices are, whatever the file calls them: many files repeat a vertex
/// for every triangle that uses it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::meshes {

/// One side of a triangle, named from its lower node.
struct TriangleSide {
  std::uint32_t low, high, triangle;
  bool forward;  ///< the triangle runs from low to high
};

class WeldedMesh {
 public:
  explicit WeldedMesh(const TriangleMesh& mesh);

  /// Distinct positions, those of vertices that no triangle uses among them.
  std::vector<Vec3> nodes;
  std::vector<std::uint32_t> node_of;  ///< one a vertex
  /// Sides of one edge stand together, in the order of their triangles; sides without length are left out.
  std::vector<TriangleSide> sides;

  /// Calls visit(span of the sides of one edge) for every edge.
  template <class Visitor>
  void each_edge(Visitor&& visit) const {
    for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
      while (next < sides.size() && sides[next].low == sides[i].low && sides[next].high == sides[i].high)
        ++next;
      visit(std::span(sides).subspan(i, next - i));
    }
  }
};

}  // namespace touchmark::bench::meshes
