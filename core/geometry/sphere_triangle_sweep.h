/// When a moving ball first touches a triangle.
///
/// Whether it does is decided exactly. The fraction is 0 where, and only where, the probe touches at the
/// start; it is never late, and early by less than 2^-50. Newton's method on the distance, which is convex
/// along the way, with checked steps; the last of them in double-double. Proof: docs/exactness.md, E16.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/geometry/point_triangle.h"
#include "core/probe.h"

namespace touchmark {

/// Bounds by how much a position on the path that is rounded to a point (position_at) can be off.
double position_error(const Sweep& sweep) noexcept;

/// What is known of the fraction of the first touch.
struct TouchBounds {
  double first, last;
};

/// Bounds of touch_fraction, both 0 where the probe touches at the start; nothing where the triangle is not
/// touched, or not before `limit`. The limit only ends the search and does not change the bounds, so that
/// detectors may look at triangles in any order. A sweep that does not move hits when it touches at once.
/// Nothing where a number is not finite (the radius may be infinite) or the radius is below 0. Counts 1 where
/// doubles did not decide.
std::optional<TouchBounds> touch_bounds(const PreparedTriangle& triangle, const Sweep& sweep, double limit,
                                        std::uint64_t& exact_decisions) noexcept;

/// The fraction in [0, 1] of the path at which the triangle is first touched, from what touch_bounds
/// returned; see above. It depends on the triangle and the sweep alone.
double touch_fraction(const PreparedTriangle& triangle, const Sweep& sweep, const TouchBounds& bounds,
                      std::uint64_t& exact_decisions) noexcept;

/// Returns touch_fraction where it is at most the limit, else nothing.
std::optional<double> sweep_hit(const PreparedTriangle& triangle, const Sweep& sweep, double limit) noexcept;

/// Does the plane with this unit normal surely keep ball and triangle apart up to a fraction of the path: by
/// so much that no fraction up to there is told for it? Costs a tenth of sweep_hit.
inline bool plane_keeps_apart(const PreparedTriangle& triangle, const Sweep& sweep, const Vec3& normal,
                              double until) noexcept {
  // With S the largest coordinate difference from the start to the corners plus the path's largest
  // coordinate, heights and the change along the path are off by 32 u S, and a fraction is early by less than
  // 14 u S.
  constexpr double error = 64 * (std::numeric_limits<double>::epsilon() / 2);
  double lowest = std::numeric_limits<double>::infinity(), largest = 0;
  for (const Vec3& corner : triangle.corner) {
    const Vec3 start = sweep.from - corner;
    lowest = std::min(lowest, normal.dot(start));
    largest = std::max(largest, start.cwiseAbs().maxCoeff());
  }
  const Vec3 path = sweep.to - sweep.from;
  return lowest + std::min(until * normal.dot(path), 0.0) - sweep.radius >
         error * (largest + path.cwiseAbs().maxCoeff());
}

/// Returns the direction of an offset; zero, which keeps nothing apart, where it is too short to have one.
/// Above the least square, S is far from the least numbers, too: no offset is longer than twice S.
inline Vec3 direction_of(const Offset& offset) noexcept {
  constexpr double min_squared = 0x1p-900;
  return offset.squared > min_squared ? Vec3(offset.vector / std::sqrt(offset.squared)) : Vec3(Vec3::Zero());
}

/// Does the plane normal to this offset, from the triangle to a point of the path, surely keep ball and
/// triangle apart all the way?
inline bool plane_keeps_apart(const PreparedTriangle& triangle, const Sweep& sweep,
                              const Offset& offset) noexcept {
  return plane_keeps_apart(triangle, sweep, direction_of(offset), 1);
}

/// The contact of the ball at this fraction of the path with this triangle. The position is not rounded to a
/// point first: only its differences to the triangle are.
Contact contact_on_path(const PreparedTriangle& triangle, const Sweep& sweep, double fraction,
                        TriangleId id) noexcept;

/// Returns where the probe stands at a fraction of the path, rounded; exact at 0 and 1.
Vec3 position_at(const Sweep& sweep, double fraction) noexcept;

}  // namespace touchmark
