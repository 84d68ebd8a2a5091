/// What both forms do with a mesh and a cell's edge before they build.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace touchmark::grid {

/// Throws std::invalid_argument for an edge that is negative, infinite or NaN.
inline void check_cell(double edge) {
  if (!(edge >= 0 && std::isfinite(edge)))
    throw std::invalid_argument("grid-group: cell is " + std::to_string(edge) +
                                ", not a finite number from 0 up");
}

/// Returns a mesh of the first triangle alone, which stands for all where all corners coincide.
inline TriangleMesh first_triangle(const TriangleMesh& mesh) {
  const std::vector<Vec3> corners = {mesh.corner(0, 0), mesh.corner(0, 1), mesh.corner(0, 2)};
  return {corners, {{0, 1, 2}}, {mesh.id(0)}};
}

}  // namespace touchmark::grid
