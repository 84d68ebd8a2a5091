/// When a moving ball first touches a triangle whose corners move, too.
///
/// For a point that is decided exactly. A ball is told to be touched where no plane that turns at an even
/// pace is found to keep both apart. Proof: docs/exactness.md, E34.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/exact/feature.h"
#include "core/probe.h"

namespace touchmark {

/// Bounds by how much the distance at a reported fraction may exceed a ball's radius. `speed` is the largest
/// that a corner has as the probe sees it, in a tick, and `size` the largest coordinate that it has so.
inline double max_early_moving_gap(double speed, double size) noexcept {
  return 0x1p-20 * speed + 512 * (std::numeric_limits<double>::epsilon() / 2) * size;
}

/// Returns the fraction in [0, limit] of the tick at which the triangle is first touched, or nothing. The
/// limit only ends the search. Nothing where a number of the sweep is not finite or the radius is below 0.
/// Counts 1 where doubles did not decide.
std::optional<double> moving_sweep_hit(const TriangleCorners& start, const TriangleCorners& end,
                                       const Sweep& sweep, double limit,
                                       std::uint64_t& exact_decisions) noexcept;

}  // namespace touchmark
