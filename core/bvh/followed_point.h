/// What is remembered of one of many points that are asked again and again: the triangles near it, in six
/// cache lines, where a haptic point has a list of leaves in four kilobytes.
#pragma once

#include <cstdint>

#include "core/bvh/plane_list.h"
#include "core/probe.h"
#include "core/search/memory/backoff.h"
#include "core/search/memory/epoch.h"

namespace touchmark::bvh {

/// Forgetting it changes the cost of the next answer, never the answer.
struct alignas(64) FollowedPoint {
  static constexpr float first_margin = 0.2F;

  Epoch epoch;                  ///< the structure that this is about
  Vec3 center = Vec3::Zero();   ///< the place about which the list was made, in the mesh's frame
  double covered = 0;           ///< no triangle that is not listed is nearer to the centre; mesh units
  std::uint32_t nearest = 0;    ///< the place of what was nearest last
  float margin = first_margin;  ///< how far beyond the nearest to list next, in mean radii of the leaves
  Backoff<std::uint16_t, 255> backoff;
  PlaneList<16, 0> list;       ///< filled up with what is infinitely far, where something is listed
  std::uint32_t answered = 0;  ///< questions of a session that this list has answered

  /// True if what is not listed is farther than `distance` from a point that is `moved` from the centre.
  bool covers(double distance, double moved) const noexcept { return distance + moved < covered; }
  /// Becomes as a new one is, for which the arrays need not be cleared.
  void start_anew() noexcept {
    epoch = {};
    margin = first_margin;
    backoff = {};
    list.start_anew();
    nearest = answered = 0;
  }
};
static_assert(sizeof(FollowedPoint) == 384);

}  // namespace touchmark::bvh
