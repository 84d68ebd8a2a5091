/// What a haptic point remembers of the hierarchy: the blocks of triangles near it, so that the next ticks
/// need not descend from the root.
#pragma once

#include <cstdint>
#include <limits>

#include "core/probe.h"
#include "core/sphere_cluster/tree/node.h"

namespace touchmark::spheres {

/// The blocks are kept with the bounds that they have in the tree, as the children of one wide node. A block
/// that is not listed was at least `covered_radius` from `center`.
struct LeafCache {
  static constexpr std::uint32_t capacity = 96;
  /// A list of no more may have more: the next one is for more ticks.
  static constexpr std::uint32_t few = 40;
  /// A node's worth may be written where one block is to be added.
  static constexpr std::uint32_t padded_capacity = capacity + tree_width;

  /// No more nodes are looked into for a list.
  static constexpr std::size_t max_nodes = 512;

  Vec3 center = Vec3::Zero();  ///< in the mesh's frame
  float covered_radius = -1;   ///< in the tree's; nothing is known
  std::uint32_t count = 0;
  float horizon_ticks = 16;  ///< for so many ticks ahead the next list is going to be
  std::uint32_t cooldown = 0,
                last_cooldown = 0;  ///< ticks until a list is made again, after there were too many
  alignas(64) float x[padded_capacity], y[padded_capacity], z[padded_capacity], radius[padded_capacity];
  alignas(64) float normal_x[padded_capacity], normal_y[padded_capacity], normal_z[padded_capacity],
      half[padded_capacity];
  alignas(64) TreeRef child[padded_capacity];

  /// Everything nearer than `limit` is going to be added.
  void start(const Vec3& at, float limit) noexcept {
    center = at;
    covered_radius = limit;
    count = 0;
  }
  /// What was listed is not all there is.
  void forget() noexcept { covered_radius = -1; }
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
