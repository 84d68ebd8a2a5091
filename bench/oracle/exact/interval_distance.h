/// Distances in plain double with certified bounds: what spares the oracle its integers.
#pragma once

#include "bench/oracle/triangle.h"

namespace touchmark::bench::oracle {

/// The true distance lies in [lo, hi]; 0 <= lo <= hi, hi may be infinite.
struct Interval {
  double lo, hi;
};

/// From a point to a triangle. Finite input, any magnitude. The width is some 40 u M for well-shaped
/// triangles, u = 2^-53 and M the largest distance to a corner; wider on slivers and close to the surface.
Interval distance_interval(const Vec3& point, const Triangle& triangle) noexcept;

/// From the segment `from`-`to` to a triangle, M being the largest distance from an end to a corner.
Interval segment_distance_interval(const Vec3& from, const Vec3& to, const Triangle& triangle) noexcept;

}  // namespace touchmark::bench::oracle
