/// What is remembered of one of many points that are asked again and again: the triangles near it, in six
/// cache lines, where a haptic point has a list of leaves in four kilobytes.
#pragma once

#include <cstdint>

#include "core/probe.h"
#include "core/search/epoch.h"

namespace touchmark::spheres {

/// Forgetting it changes the cost of the next answer, never the answer.
///
/// A triangle is listed behind a plane. In the tree's frame it is at least bound + (x, y, z) . (p - center)
/// from a point p, with (x, y, z) a unit vector, or 0: docs/exactness.md, E14.
struct alignas(64) FollowedPoint {
  static constexpr std::uint32_t capacity = 16;

  Epoch epoch;                 ///< the structure that this is about
  Vec3 center = Vec3::Zero();  ///< the place about which the list was made
  double covered = 0;          ///< no triangle that is not listed is nearer to the centre; mesh units
  std::uint32_t count = 0;
  std::uint32_t nearest = 0;  ///< the place of what was nearest last
  float margin = 0.2F;        ///< how far beyond the nearest to list next, in mean radii of the leaves
  std::uint16_t cooldown = 0,
                last_cooldown = 0;  ///< queries until the next list, after one that did not serve
  std::uint32_t slot[capacity];
  float bound[capacity];  ///< infinite from `count` on, where something is listed
  float x[capacity], y[capacity], z[capacity];
};

}  // namespace touchmark::spheres
