/// How long a haptic point need not look at bodies that it has seen to be far: a certificate that expires by
/// motion. docs/exactness.md, E29.
#pragma once

#include <limits>

#include "core/probe.h"
#include "core/scene/scene_bodies.h"
#include "core/search/memory/epoch.h"

namespace touchmark {

/// All bodies that it is about were at least `lower` from `center` when the scene had seen so many moves.
struct Clearance {
  Epoch epoch;
  std::uint64_t additions = 0;  ///< a body that was added later is not covered
  Vec3 center = Vec3::Zero();
  std::uint64_t moves = 0;
  double motion = 0;  ///< before the span of moves of that time: others of that span may still come
  double lower = -std::numeric_limits<double>::infinity();

  static Clearance at(const Vec3& center, double lower, const SceneBodies& bodies) noexcept {
    return {bodies.epoch(), bodies.additions(), center, bodies.moves(), bodies.motion_before_span(), lower};
  }
  bool is_about(const SceneBodies& bodies) const noexcept {
    return epoch == bodies.epoch() && additions == bodies.additions();
  }
  /// Returns what the bodies' distance to a point still cannot fall below: it changes by no more than the
  /// point has moved, and a body.
  double remaining(const Vec3& point, const SceneBodies& bodies) const noexcept;
  /// Is every body surely farther from the point than this?
  bool clears(const Vec3& point, double reach, const SceneBodies& bodies) const noexcept {
    return is_about(bodies) && remaining(point, bodies) > reach;
  }
};

}  // namespace touchmark
