/// What any computed distance of a query may be off by, and the unit in which it can be computed:
/// docs/exactness.md, E2 and E9.
#pragma once

#include <algorithm>
#include <limits>

#include "core/aabb.h"
#include "core/probe.h"

namespace touchmark {

/// The largest coordinate difference between the point and the box's corners.
inline double largest_difference(const Aabb& box, const Vec3& point) noexcept {
  return (point - box.min).cwiseAbs().cwiseMax((point - box.max).cwiseAbs()).maxCoeff();
}

/// The largest coordinate difference for any point of a path: a convex function is greatest at an end.
inline double largest_difference(const Aabb& box, const Sweep& sweep) noexcept {
  return std::max(largest_difference(box, sweep.from), largest_difference(box, sweep.to));
}

/// Do fourth powers of the differences stay in the range of double? Else nothing is known of the kernel's
/// results: below 2^-132, above 2^232, or for no number. There, ask LinearScan, which measures in another
/// unit.
inline bool fourth_powers_fit(double largest_difference) noexcept {
  return largest_difference >= 0x1p-132 && largest_difference <= 0x1p232;
}

/// See above. Infinite where fourth powers do not fit.
inline double distance_error(double largest_difference) noexcept {
  constexpr double relative_error = 256 * (std::numeric_limits<double>::epsilon() / 2);
  constexpr double underflow = 0x1p-200;
  if (!fourth_powers_fit(largest_difference)) return std::numeric_limits<double>::infinity();
  return relative_error * largest_difference + underflow;
}
/// The power of two that brings such a difference near 1, or as near as the range of doubles lets it; 1 for
/// none at all.
double unit_for(double largest_difference) noexcept;
inline double distance_error(const Aabb& bounds, const Vec3& center) noexcept {
  return distance_error(largest_difference(bounds, center));
}

}  // namespace touchmark
