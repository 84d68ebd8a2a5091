/// Parts of the hierarchy that are left to the first queries that come there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/search/memory/lazy_construction.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/triangle_mesh.h"

namespace touchmark::bvh {

/// What a tree needs to build the rest of itself. It is empty where the tree is whole.
struct UnbuiltParts {
  /// Triangles [begin, end) of the tree's order, in whole blocks. Its nodes follow one another from `node`
  /// on, which is their root.
  struct Part {
    std::uint32_t begin, end, node;
  };
  /// No part has more triangles than this: to build so many takes a query 0.1 to 0.3 ms.
  static constexpr std::uint32_t part_size = 512;

  std::vector<LazyState> states;  ///< how far each part is
  std::vector<Part> parts;
  std::vector<std::uint32_t> order;  ///< the mesh's triangles, one part's after the other's
  std::shared_ptr<const TriangleMesh> mesh;
  FilterFrame frame;
  double mean_leaf_radius = 0;  ///< in the frame, by a sample

  bool empty() const noexcept { return parts.empty(); }
  /// The triangles are held once for all copies.
  std::size_t bytes() const noexcept {
    const std::size_t of_mesh = mesh ? mesh->vertices().size_bytes() + mesh->triangles().size_bytes() : 0;
    return states.capacity() * sizeof(LazyState) + parts.capacity() * sizeof(Part) +
           order.capacity() * sizeof(std::uint32_t) + of_mesh;
  }
};

}  // namespace touchmark::bvh
