/// Boxes in place of cylinders, for a tree whose triangles fill boxes better: plates and beams along the
/// axes.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "core/search/plane_filter.h"
#include "core/sphere_cluster/tree/node.h"

namespace touchmark::spheres {

/// A box in the tree's frame, along its axes, in single precision.
struct BoundingBox {
  Eigen::Vector3f center, half;
};

/// Returns a box that certainly holds what is below a child. Below a node that is what its children's boxes
/// hold: they must have been set before.
BoundingBox box_below(const TreeParts& parts, TreeRef child, const FilterFrame& frame) noexcept;

void set_child(TreeNode& node, std::size_t i, const BoundingBox& box) noexcept;

/// Bounds all children of a tree of cylinders by boxes instead, if those let fewer points near the surface
/// through.
void choose_bounds(TreeParts& parts, const FilterFrame& frame);

}  // namespace touchmark::spheres
