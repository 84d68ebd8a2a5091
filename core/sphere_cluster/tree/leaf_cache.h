/// What a haptic point remembers of the hierarchy: the blocks of triangles near it, so that the next ticks
/// need not start from the root.
#pragma once

#include <cstdint>
#include <limits>

#include "core/probe.h"
#include "core/sphere_cluster/tree/node.h"

namespace touchmark::spheres {

/// Leaves (blocks of triangles) with the bounds that they have in the tree, as the children of one wide node.
/// A leaf that is not in it was at least `covered_radius` from `center`.
struct LeafCache {
  static constexpr std::uint32_t capacity = 96;
  /// With no more leaves than this the next refill is for more ticks.
  static constexpr std::uint32_t few = 40;
  /// The capacity of the arrays: a node's worth may be written where one leaf is to be added.
  static constexpr std::uint32_t padded_capacity = capacity + tree_width;

  static constexpr float first_horizon_ticks = 16;
  /// The most nodes that are looked into for one refill.
  static constexpr std::size_t max_nodes = 512;

  Vec3 center = Vec3::Zero();  ///< centre of the ball that the cache covers, in the mesh's frame
  float covered_radius = -1;   ///< radius of that ball, in the tree's frame; below 0: nothing is known
  std::uint32_t count = 0;
  float horizon_ticks = first_horizon_ticks;  ///< how many ticks ahead the next refill is to cover
  std::uint32_t cooldown = 0,
                last_cooldown = 0;  ///< ticks until the next refill, after there were too many leaves
  alignas(64) float x[padded_capacity], y[padded_capacity], z[padded_capacity], radius[padded_capacity];
  alignas(64) float normal_x[padded_capacity], normal_y[padded_capacity], normal_z[padded_capacity],
      half[padded_capacity];
  alignas(64) TreeRef child[padded_capacity];

  /// Starts a refill: everything nearer than `limit` to `at` is going to be added.
  void start(const Vec3& at, float limit) noexcept {
    center = at;
    covered_radius = limit;
    count = 0;
  }
  /// Gives the refill up: what was added is not all there is.
  void forget() noexcept { covered_radius = -1; }
  /// Becomes as a new one is, for which the arrays need not be cleared.
  void start_anew() noexcept {
    forget();
    center = Vec3::Zero();
    count = cooldown = last_cooldown = 0;
    horizon_ticks = first_horizon_ticks;
  }
  /// Fills up the last eight with what is infinitely far.
  void finish() noexcept {
    for (std::uint32_t i = count; i % tree_width != 0; ++i) {
      x[i] = y[i] = z[i] = radius[i] = normal_x[i] = normal_y[i] = normal_z[i] = 0;
      half[i] = -std::numeric_limits<float>::infinity();
      child[i] = {0};
    }
  }
};

}  // namespace touchmark::spheres
