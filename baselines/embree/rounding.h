/// What Embree's callbacks are given by both detectors: boxes in its single precision, and a count of its
/// memory.
#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>

#include <sys/types.h>

#include "core/aabb.h"

namespace touchmark::baselines {

/// Returns the least float that is no less than x, or infinity.
inline float rounded_up(double x) noexcept {
  const auto nearest = static_cast<float>(x);
  return nearest < x ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}
inline float rounded_down(double x) noexcept { return -rounded_up(-x); }

/// Rounds a box outward into Embree's bounds.
template <class Bounds>
void set_bounds(Bounds& out, const Aabb& box) noexcept {
  out.lower_x = rounded_down(box.min.x());
  out.lower_y = rounded_down(box.min.y());
  out.lower_z = rounded_down(box.min.z());
  out.upper_x = rounded_up(box.max.x());
  out.upper_y = rounded_up(box.max.y());
  out.upper_z = rounded_up(box.max.z());
}

/// Adds to `taken`, an atomic number, what Embree's memory monitor reports.
inline bool count_bytes(void* taken, ssize_t bytes, bool) {
  *static_cast<std::atomic<std::ptrdiff_t>*>(taken) += bytes;
  return true;
}

}  // namespace touchmark::baselines
