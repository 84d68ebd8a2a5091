/// What a haptic point remembers of the hierarchy: the blocks of triangles near it, so that the next ticks
/// need not start from the root.
#pragma once

#include <algorithm>
#include <cstddef>
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
  static constexpr std::uint32_t longest_cooldown = 255;
  /// After so many refills a descent tells anew what it costs.
  static constexpr std::uint32_t refills_a_descent = 32;

  Vec3 center = Vec3::Zero();  ///< centre of the ball that the cache covers, in the mesh's frame
  float covered_radius = -1;   ///< radius of that ball, in the tree's frame; below 0: nothing is known
  std::uint32_t count = 0;
  float horizon_ticks = first_horizon_ticks;  ///< how many ticks ahead the next refill is to cover
  std::uint32_t cooldown = 0,
                last_cooldown = 0;  ///< ticks until the next refill, after one that did not serve
  /// What a descent near the surface costs, about, and what the last refills and their searches have cost,
  /// the later the more, in spheres of a list; 0: nothing is known.
  std::uint64_t descent_cost = 0, spent = 0;
  std::uint64_t searches = 0;  ///< what `spent` was spent on
  std::uint32_t refills = 0;   ///< since a descent was to tell what it costs
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
  /// Puts the next refill off, each time for longer.
  void wait() noexcept {
    last_cooldown = std::min(longest_cooldown, 2 * last_cooldown + 1);
    cooldown = last_cooldown;
  }
  /// May the cache be refilled? Not where the last refills have cost more than descents would have.
  bool may_refill() noexcept {
    if (cooldown > 0) {
      --cooldown;
      return false;
    }
    if (spent > 0) {
      // Lists go on where both cost about the same, since what comes next may be slower.
      const bool saved = 5 * spent <= 6 * (searches * descent_cost);
      if (!saved) {
        spent = searches = 0;
        wait();
        return false;
      }
      // Half of the account stays, so that lists that saved make up for one that is left too soon.
      spent /= 2;
      searches /= 2;
      last_cooldown = 0;
    }
    if (descent_cost > 0 && ++refills < refills_a_descent) return true;
    refills = 0;
    return false;
  }
  // Measured on scenes of the suite: a sphere of a descent, which waits for its node, costs four times as
  // much as one of a list or of a refill, and a triangle twenty times.
  static std::uint64_t cost_of(std::uint64_t spheres, std::uint64_t triangles) noexcept {
    return spheres + 20 * triangles;
  }
  void count_descent(std::uint64_t spheres, std::uint64_t triangles) noexcept {
    const std::uint64_t cost = cost_of(4 * spheres, triangles);
    descent_cost = descent_cost > 0 ? (3 * descent_cost + cost) / 4 : cost;
  }
  void count_refill(std::uint64_t spheres) noexcept { spent += cost_of(spheres, 0); }
  void count_search(std::uint64_t spheres, std::uint64_t triangles) noexcept {
    ++searches;
    spent += cost_of(spheres, triangles);
  }
  /// Becomes as a new one is, for which the arrays need not be cleared.
  void start_anew() noexcept {
    forget();
    center = Vec3::Zero();
    count = cooldown = last_cooldown = refills = 0;
    descent_cost = spent = searches = 0;
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
