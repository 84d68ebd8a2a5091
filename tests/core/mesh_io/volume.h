/// What a closed mesh encloses.
#pragma once

#include "core/triangle_mesh.h"

namespace touchmark::test {

/// In cubic mesh units: negative where its faces look inwards.
inline double volume(const TriangleMesh& mesh) {
  double six = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i)
    six += mesh.corner(i, 0).dot(mesh.corner(i, 1).cross(mesh.corner(i, 2)));
  return six / 6;
}

}  // namespace touchmark::test
