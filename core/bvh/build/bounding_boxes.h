/// Boxes around what is below a child. Cylinders are for meshes whose triangles fill boxes far worse: needles
/// and fans across the axes.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "core/bvh/node.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/triangle_mesh.h"

namespace touchmark::bvh {

/// A box in the tree's frame, along its axes, in single precision.
struct BoundingBox {
  Eigen::Vector3f center, half;
};

/// Returns a box that certainly holds what is below a child. Below a node that is what its children's boxes
/// hold: they must have been set before.
BoundingBox box_below(const Parts& parts, ChildRef child, const FilterFrame& frame) noexcept;

void set_child(Node& node, std::size_t i, const BoundingBox& box) noexcept;

/// Returns a box that certainly holds all points that rounding to the nearest puts between these two.
BoundingBox box_between(const Eigen::Vector3f& low, const Eigen::Vector3f& high) noexcept;

/// Would boxes around the children be looked into less often, near the surface, than cylinders? A sample of
/// the blocks tells. Nothing needs to be bounded yet.
bool boxes_serve_better(const Parts& parts, const TriangleMesh& mesh, const FilterFrame& frame);

/// Bounds all children by boxes. The same bits with any number of threads.
void bound_by_boxes(Parts& parts, const FilterFrame& frame, unsigned threads);

}  // namespace touchmark::bvh
