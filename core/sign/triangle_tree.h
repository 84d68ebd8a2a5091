/// Triangles under nested boxes, visited by whatever test of a box the caller brings. The boxes are the
/// corners' own coordinates, so nothing about them is rounded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aabb.h"
#include "core/exact/distance_predicates.h"
#include "core/triangle_mesh.h"

namespace touchmark::sign {

class TriangleTree {
 public:
  struct Item {
    TriangleCorners corner;
    std::uint32_t index;  ///< in the mesh
  };

  TriangleTree() = default;
  explicit TriangleTree(const TriangleMesh& mesh);

  /// Calls visit(item) for every triangle of every leaf whose box and all boxes above it pass the test.
  template <class Test, class Visit>
  void visit(const Test& passes, const Visit& visit) const;

  std::size_t bytes() const noexcept {
    return nodes_.capacity() * sizeof(Node) + items_.capacity() * sizeof(Item);
  }

 private:
  struct Node {
    Aabb box;
    std::uint32_t first = 0;  ///< a leaf's first item; else the second child, the first one is the next node
    std::uint32_t count = 0;  ///< number of a leaf's items; 0: not a leaf
  };
  class Builder;
  // Halving 2^32 triangles goes 32 deep, and each step leaves one sibling behind.
  static constexpr std::size_t max_stack = 34;

  std::vector<Node> nodes_;
  std::vector<Item> items_;
};

template <class Test, class Visit>
void TriangleTree::visit(const Test& passes, const Visit& visit) const {
  std::array<std::uint32_t, max_stack> stack;
  std::size_t count = 0;
  stack[count++] = 0;
  while (count > 0) {
    const std::uint32_t index = stack[--count];
    const Node& node = nodes_[index];
    if (!passes(node.box)) continue;
    if (node.count == 0) {
      stack[count++] = node.first;
      stack[count++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(items_[i]);
  }
}

}  // namespace touchmark::sign
