/// Doubles as floats that are rounded in a direction that is known.
#pragma once

#include <cmath>
#include <limits>

namespace touchmark {

/// Returns the greatest float that is no more than x.
inline float rounded_down(double x) noexcept {
  const auto near = static_cast<float>(x);
  return static_cast<double>(near) <= x ? near
                                        : std::nextafter(near, -std::numeric_limits<float>::infinity());
}
/// Returns the least float that is no less than x.
inline float rounded_up(double x) noexcept { return -rounded_down(-x); }

}  // namespace touchmark
