/// How triangles and bounds get into the hierarchy's arrays, when it is built and when it is moved.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "core/geometry/plane_filter.h"
#include "core/sphere_cluster/tree_bounds.h"
#include "core/sphere_cluster/tree_layout.h"

namespace touchmark::spheres {

/// Bounds the triangles added since the last bound(). To be kept: it keeps its memory.
class BoundOfTriangles {
 public:
  explicit BoundOfTriangles(const FilterFrame& frame) : frame_(frame) {}

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::array<Vec3, 3> v = {frame_.to_frame(a), frame_.to_frame(b), frame_.to_frame(c)};
    corners_.insert(corners_.end(), v.begin(), v.end());
    normal_ += (v[1] - v[0]).cross(v[2] - v[0]);
  }
  SlabbedSphere bound() {
    const SlabbedSphere found = bound_points(corners_, normal_);
    corners_.clear();
    normal_ = Vec3::Zero();
    return found;
  }

 private:
  const FilterFrame& frame_;
  std::vector<Vec3> corners_;
  Vec3 normal_ = Vec3::Zero();
};

inline void set_child(TreeNode& node, std::size_t i, const SlabbedSphere& bound) noexcept {
  node.x[i] = bound.center.x();
  node.y[i] = bound.center.y();
  node.z[i] = bound.center.z();
  node.radius[i] = bound.radius;
  node.normal_x[i] = bound.normal.x();
  node.normal_y[i] = bound.normal.y();
  node.normal_z[i] = bound.normal.z();
  node.half[i] = bound.half;
}

inline void set_triangle(TriangleBlock& block, std::size_t i, const TrianglePlanes& planes) noexcept {
  for (int k = 0; k < 4; ++k) {
    block.x[k][i] = planes.x[k];
    block.y[k][i] = planes.y[k];
    block.z[k][i] = planes.z[k];
    block.offset[k][i] = planes.offset[k];
  }
}

}  // namespace touchmark::spheres
