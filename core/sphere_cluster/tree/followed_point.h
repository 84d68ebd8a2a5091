/// What is remembered of one of many points that are asked again and again: the triangles near it, in two
/// cache lines, where a haptic point has a list of leaves in four kilobytes.
#pragma once

#include <cstdint>

#include "core/probe.h"
#include "core/search/epoch.h"

namespace touchmark::spheres {

/// Forgetting it changes the cost of the next answer, never the answer.
struct alignas(64) FollowedPoint {
  static constexpr std::uint32_t capacity = 10;

  Epoch epoch;                 ///< the structure that this is about
  Vec3 center = Vec3::Zero();  ///< the point when it was asked last
  double covered = 0;          ///< no triangle that is not listed is nearer to the centre; mesh units
  std::uint32_t count = 0;
  std::uint32_t nearest = 0;  ///< the place of the nearest
  std::uint32_t slot[capacity];
  float
      distance[capacity];  ///< at most those of the listed triangles from the centre, in the frame; ascending
};

}  // namespace touchmark::spheres
