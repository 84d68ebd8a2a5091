/// The rounding of doubles to Embree's single precision.
#pragma once

#include <cmath>
#include <limits>

namespace touchmark::baselines {

/// Returns the least float that is no less than x, or infinity.
inline float rounded_up(double x) noexcept {
  const auto nearest = static_cast<float>(x);
  return nearest < x ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}
inline float rounded_down(double x) noexcept { return -rounded_up(-x); }

}  // namespace touchmark::baselines
