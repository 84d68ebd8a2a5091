/// The oracle's culling: a binary tree of boxes that are the triangles' own coordinates, so not rounded at
/// all. What is rounded is a distance to a box, and that downwards.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "bench/oracle/triangle.h"

namespace touchmark::bench::oracle {

struct Box {
  Vec3 min, max;
};

inline Box box_of(const Triangle& t) noexcept {
  return {t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
}

/// A number not above the distance from the point to the box.
double distance_below(const Box& box, const Vec3& point) noexcept;
/// Returns a lower bound of the distance from the segment `from`-`to` to the box.
double distance_below(const Box& box, const Vec3& from, const Vec3& to) noexcept;
/// Returns one that is found faster, and tells less of a long segment: the distance of its own box.
double distance_of_boxes_below(const Box& box, const Vec3& from, const Vec3& to) noexcept;

class TriangleTree {
 public:
  explicit TriangleTree(const TriangleMesh& mesh);

  /// Calls visit(triangle) for every triangle in a leaf whose box, and every box above it, has
  /// below(box) <= limit. `limit` may shrink meanwhile. Nearer boxes first.
  template <class Below, class Visit>
  void visit(const Below& below, const double& limit, const Visit& visit) const;

  std::size_t bytes() const noexcept {
    return nodes_.capacity() * sizeof(Node) + order_.capacity() * sizeof(order_[0]);
  }

 private:
  struct Node {
    Box box;
    std::uint32_t first;  ///< leaf: index into order_; else: the second child (the first one is next)
    std::uint32_t count;  ///< a leaf's triangles; 0: not a leaf
  };
  struct Key;

  void build(const TriangleMesh& mesh, std::vector<Key>& keys, std::uint32_t begin, std::uint32_t end,
             std::uint32_t node, int depth);
  Box leaf_box(const TriangleMesh& mesh, std::uint32_t begin, std::uint32_t end) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

template <class Below, class Visit>
void TriangleTree::visit(const Below& below, const double& limit, const Visit& visit) const {
  // Halving 2^32 triangles goes 32 deep, and each step leaves one sibling behind.
  std::array<std::pair<double, std::uint32_t>, 64> stack;
  std::size_t size = 0;
  const auto push = [&](std::uint32_t node) {
    const double distance = below(nodes_[node].box);
    if (distance <= limit) stack[size++] = {distance, node};
  };
  push(0);
  while (size > 0) {
    const auto [distance, index] = stack[--size];
    if (!(distance <= limit)) continue;
    const Node& node = nodes_[index];
    if (node.count > 0) {
      for (std::uint32_t i = 0; i < node.count; ++i) visit(order_[node.first + i]);
      continue;
    }
    const std::size_t before = size;
    push(index + 1);
    push(node.first);
    if (size == before + 2 && stack[before].first < stack[before + 1].first)
      std::swap(stack[before], stack[before + 1]);
  }
}

}  // namespace touchmark::bench::oracle
