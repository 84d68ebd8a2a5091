/// When a moving ball first touches a triangle.
///
/// The distance from a point to a convex set, along a straight line, is a convex function of the way. So
/// Newton's method from the start approaches the first touch from before, never past it, and stops where the
/// distance no longer falls: no case distinction into faces, edges and corners, and the point-triangle
/// kernel's accuracy. Where the slope drowns in rounding, the least distance is searched by comparing alone.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/geometry/point_triangle.h"
#include "core/probe.h"

namespace touchmark {

/// By how much a computed position on the way can be off: relative to the coordinates, not to differences of
/// them, since a position is a sum of coordinates.
double position_error(const Sweep& sweep) noexcept;

/// The first fraction in [0, limit] of the way at which the distance to the triangle is at most the radius,
/// or nothing. Touching is decided within an error of 48 u M + position_error (u = 2^-53, M the largest
/// coordinate difference between the triangle and the position): a ball that passes at the radius plus that
/// may be reported as touching, one that touches is always found. A sweep that does not move hits when it
/// touches at once.
std::optional<double> sweep_hit(const PreparedTriangle& triangle, const Sweep& sweep, double limit) noexcept;

/// Where the probe stands at a fraction of the way; exact at 0 and 1.
inline Vec3 position_at(const Sweep& sweep, double fraction) noexcept {
  return fraction < 1 ? Vec3(sweep.from + fraction * (sweep.to - sweep.from)) : sweep.to;
}

/// A candidate for the first touch: smaller fraction first, then lower index, so that detectors which look at
/// triangles in any order agree bit for bit.
struct HitCandidate {
  double fraction = std::numeric_limits<double>::infinity();
  std::uint32_t index = std::numeric_limits<std::uint32_t>::max();

  bool operator<(const HitCandidate& other) const noexcept {
    return fraction < other.fraction || (fraction == other.fraction && index < other.index);
  }
};

}  // namespace touchmark
