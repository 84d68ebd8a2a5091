/// A corner, an edge or a face of a triangle, told by its corners.
#pragma once

#include <array>

#include "core/probe.h"

namespace touchmark {

using TriangleCorners = std::array<Vec3, 3>;

/// One corner, the two ends of an edge, or the three corners of a face; behind them are copies of the first.
struct Feature {
  std::array<Vec3, 3> corner;
  int corners = 0;
};

}  // namespace touchmark
