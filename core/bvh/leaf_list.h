/// The blocks of triangles around a point, so that a search need not start from the root.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/bvh/node.h"
#include "core/probe.h"

namespace touchmark::bvh {

/// Leaves (blocks of triangles) with the bounds that they have in the tree. A leaf that is not listed was at
/// least `covered_radius` from `center`.
struct LeafList {
  static constexpr std::uint32_t capacity = 96;
  /// A node's worth may be written where one leaf is to be added.
  static constexpr std::uint32_t padded_capacity = capacity + width;
  /// The most nodes that are looked into to list leaves.
  static constexpr std::size_t max_nodes = 512;

  Vec3 center = Vec3::Zero();  ///< centre of the ball that the list covers, in the mesh's frame
  float covered_radius = -1;   ///< radius of that ball, in the tree's frame; below 0: nothing is known
  std::uint32_t count = 0;
  Children<padded_capacity> leaves;

  /// Starts a list: everything nearer than `limit` to `at` is going to be added.
  void start(const Vec3& at, float limit) noexcept {
    center = at;
    covered_radius = limit;
    count = 0;
  }
  /// Gives the list up: what was added is not all there is.
  void forget() noexcept { covered_radius = -1; }
  /// Fills up the last eight with what is infinitely far.
  void finish() noexcept {
    for (std::uint32_t i = count; i % width != 0; ++i) leaves.clear(i);
  }
};

}  // namespace touchmark::bvh
