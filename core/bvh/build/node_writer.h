/// How triangles and bounds get into the hierarchy's arrays, when it is built and when it is moved.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/bvh/build/bounding_cylinder.h"
#include "core/bvh/node.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/triangle_mesh.h"

namespace touchmark::bvh {

/// Bounds the triangles added since the last bound(). To be kept, one a thread: it keeps its memory.
class BoundOfTriangles {
 public:
  BoundOfTriangles(const TriangleMesh& mesh, const FilterFrame& frame)
      : mesh_(mesh), frame_(frame), added_(mesh.vertices().size(), 0) {}

  void add(std::uint32_t triangle) {
    std::array<Vec3, 3> v;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh_.triangles()[triangle][k];
      v[k] = frame_.to_frame(mesh_.vertices()[vertex]);
      if (std::exchange(added_[vertex], bounds_) != bounds_) points_.add(v[k]);
    }
    facing_.add((v[1] - v[0]).cross(v[2] - v[0]));
  }
  BoundingCylinder bound() {
    const BoundingCylinder found = bound_points(points_, facing_);
    points_.clear();
    facing_ = {};
    ++bounds_;
    return found;
  }

 private:
  const TriangleMesh& mesh_;
  const FilterFrame& frame_;
  /// Triangles share their vertices: which bound a vertex was last added to, the first being 1.
  std::vector<std::uint32_t> added_;
  std::uint32_t bounds_ = 1;
  PointList points_;
  Facing facing_;
};

inline void set_child(Node& node, std::size_t i, const BoundingCylinder& bound) noexcept {
  node.set_cylinder(i, bound.center, bound.radius, bound.normal, bound.half);
}

inline void set_triangle(TriangleBlock& block, std::size_t i, const TrianglePlanes& planes) noexcept {
  for (int k = 0; k < 4; ++k) {
    block.x[k][i] = planes.x[k];
    block.y[k][i] = planes.y[k];
    block.z[k][i] = planes.z[k];
    block.offset[k][i] = planes.offset[k];
  }
}

/// Prepares the triangles of a block, triangle(slot) of the mesh, and writes their planes.
template <class TriangleIn>
void set_block(Parts& parts, std::size_t index, const TriangleMesh& mesh, const FilterFrame& frame,
               const TriangleIn& triangle) noexcept {
  TriangleBlock& block = parts.blocks[index];
  const std::size_t first = index * width, end = std::min(first + width, parts.triangles.size());
  if (end - first < width) {
    block = {};
    std::fill(std::begin(block.offset[0]), std::end(block.offset[0]), std::numeric_limits<float>::max());
  }
  for (std::size_t at = first; at < end; ++at) {
    parts.triangles[at] = prepare(mesh, triangle(at));
    set_triangle(block, at - first, planes_of(parts.triangles[at], frame));
  }
}

}  // namespace touchmark::bvh
