/// What a haptic point remembers of the hierarchy: the blocks of triangles near it, so that the next ticks
/// need not descend from the root.
#pragma once

#include <cstdint>
#include <limits>

#include "core/probe.h"
#include "core/sphere_cluster/tree/node.h"

namespace touchmark::spheres {

/// The blocks are kept with the bounds that they have in the tree, as the children of one wide node. A block
/// that is not listed was at least `rest` from `anchor`.
struct NearBlocks {
  static constexpr std::uint32_t capacity = 96;
  /// A list of no more may have more: the next one is for more ticks.
  static constexpr std::uint32_t few = 40;
  /// A node's worth may be written where one block is to be added.
  static constexpr std::uint32_t room = capacity + tree_width;

  /// No more nodes are looked into for a list.
  static constexpr std::size_t most_nodes = 512;

  Vec3 anchor = Vec3::Zero();  ///< in the mesh's frame
  float rest = -1;             ///< in the tree's; nothing is known
  std::uint32_t count = 0;
  float ticks = 16;                         ///< for so many ticks ahead the next list is going to be
  std::uint32_t pause = 0, last_pause = 0;  ///< ticks until a list is made again, after there were too many
  alignas(64) float x[room], y[room], z[room], radius[room];
  alignas(64) float normal_x[room], normal_y[room], normal_z[room], half[room];
  alignas(64) TreeRef child[room];

  /// Everything nearer than `limit` is going to be added.
  void start(const Vec3& at, float limit) noexcept {
    anchor = at;
    rest = limit;
    count = 0;
  }
  /// What was listed is not all there is.
  void forget() noexcept { rest = -1; }
  /// Puts what is infinitely far into the places that fill up the last eight.
  void finish() noexcept {
    for (std::uint32_t i = count; i % tree_width != 0; ++i) {
      x[i] = y[i] = z[i] = radius[i] = normal_x[i] = normal_y[i] = normal_z[i] = 0;
      half[i] = -std::numeric_limits<float>::infinity();
      child[i] = {0};
    }
  }
};

}  // namespace touchmark::spheres
