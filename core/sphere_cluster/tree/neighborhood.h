/// What a session that asks for contacts remembers of the triangles around: those in a ball, each behind a
/// plane that bounds its distance all around, so that sweeps and contacts in that ball look at few of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/sphere_cluster/tree/near_triangles.h"

namespace touchmark::spheres {

/// Forgetting it changes the cost of the next answer, never the answer. Bounds are about `center`.
struct Neighborhood : NearTrianglesUpTo<256> {
  static constexpr float first_margin = 0.2F;
  static constexpr std::uint32_t answers_that_pay = 3;

  Vec3 center = Vec3::Zero();   ///< in the mesh's frame
  double covered = -1;          ///< no triangle that is not listed is nearer to the centre; below 0: no list
  double contacts_reach = -1;   ///< about the largest of the contacts asked for last; below 0: none were
  double longest_way = 0;       ///< about the largest of the sweeps asked for last
  float margin = first_margin;  ///< how far beyond what is asked to list next, in mean radii of the leaves
  std::uint16_t cooldown = 0,
                last_cooldown = 0;  ///< queries until the next list, after one that did not serve
  /// Questions that the last list has answered. One that answers fewer than those that pay has cost more than
  /// it has saved.
  std::uint32_t answered = answers_that_pay;

  /// What was found of those within the reach at the last contacts, in the order of their places in the list.
  struct Measured {
    std::uint32_t place;
    Offset offset;
  };
  Vec3 measured_at = Vec3::Zero();
  std::uint32_t measured_count = 0;
  std::array<Measured, 16> measured;

  /// Puts the next list off, each time for longer.
  void wait() noexcept {
    constexpr int longest = 63;
    last_cooldown = static_cast<std::uint16_t>(std::min<int>(2 * last_cooldown + 1, longest));
    cooldown = last_cooldown;
  }
  /// Becomes as a new one is, for which the arrays need not be cleared.
  void start_anew() noexcept {
    center = measured_at = Vec3::Zero();
    covered = contacts_reach = -1;
    longest_way = 0;
    count = measured_count = 0;
    margin = first_margin;
    cooldown = last_cooldown = 0;
    answered = answers_that_pay;
  }
  /// Fills up the last eight with what is infinitely far.
  void finish() noexcept {
    for (std::uint32_t i = count; i % tree_width != 0; ++i) {
      slot[i] = 0;
      bound[i] = std::numeric_limits<float>::infinity();
      x[i] = y[i] = z[i] = 0;
    }
  }
};

/// The places in a list of the triangles that a question is about.
struct PlacesInList {
  std::array<std::uint32_t, Neighborhood::padded_capacity> at;
  std::uint32_t count = 0;
};

/// From the centre of a neighborhood to a point, in the tree's frame.
struct MoveFromCenter {
  float x, y, z;
};

}  // namespace touchmark::spheres
