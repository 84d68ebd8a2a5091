/// What tests of scenes put into them.
#pragma once

#include "core/scene/pose.h"
#include "core/triangle_mesh.h"

namespace touchmark::test {

/// The square |x|, |y| <= 1 in the plane z = 0, seen from above.
inline TriangleMesh square() {
  return TriangleMesh({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

inline Pose at(double x, double y, double z) { return {Eigen::Matrix3d::Identity(), {x, y, z}}; }

}  // namespace touchmark::test
