/// What a haptic point remembers of its distance to the mesh from one tick to the next.
#pragma once

#include <cstdint>
#include <limits>

#include "core/probe.h"
#include "core/search/memory/epoch.h"

namespace touchmark {

/// Forgetting it changes the cost of the next answer, never the answer.
struct LastDistance {
  Epoch epoch;                 ///< the structure that this is about
  std::uint32_t slot = 0;      ///< slot of a triangle that was near
  Vec3 center = Vec3::Zero();  ///< last position of the point
  /// Bounds of the distance at that centre, padded as the structure needs it. The distance changes by no more
  /// than the point moves.
  double lower = 0, upper = std::numeric_limits<double>::infinity();

  /// Was a triangle near, so that its distance bounds the next one?
  bool is_near() const noexcept { return upper < std::numeric_limits<double>::infinity(); }
  void forget_distance() noexcept {
    lower = 0;
    upper = std::numeric_limits<double>::infinity();
  }
};

}  // namespace touchmark
