/// A straight line through points.
#pragma once

#include <cstddef>
#include <span>
#include <utility>

namespace touchmark::bench::experiments::papers {

struct LineFit {
  double offset = 0;  ///< y at x = 0
  double slope = 0;
};

/// The line with the least sum of squared differences in y. At least two points of different x.
inline LineFit line_through(std::span<const std::pair<double, double>> points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [px, py] : points) {
    x += px;
    y += py;
  }
  const auto count = static_cast<double>(points.size());
  x /= count;
  y /= count;
  for (const auto& [px, py] : points) {
    xx += (px - x) * (px - x);
    xy += (px - x) * (py - y);
  }
  const double slope = xy / xx;
  return {y - slope * x, slope};
}

}  // namespace touchmark::bench::experiments::papers
