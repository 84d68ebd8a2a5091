#include "core/sphere_cluster/tree/bounding_boxes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace touchmark::spheres {
namespace {

using Eigen::Vector3f;
using BoxesOfNode = std::array<BoundingBox, tree_width>;

constexpr double pi = 3.14159;

/// From how far off bounds are compared, in mean radii of the blocks' cylinders.
constexpr double comparing_margin = 0.5;

bool is_empty(const TreeNode& node, std::size_t i) noexcept { return node.half[i] < 0; }

BoundingBox box_of(const TreeNode& node, std::size_t i) noexcept {
  return {{node.x[i], node.y[i], node.z[i]}, {node.half[i], node.radius[i], node.normal_x[i]}};
}

class Hull {
 public:
  void add(const Vector3f& low, const Vector3f& high) noexcept {
    low_ = low_.cwiseMin(low);
    high_ = high_.cwiseMax(high);
  }
  void add(const BoundingBox& box) noexcept { add(box.center - box.half, box.center + box.half); }

  /// With u = 2^-24: coordinates are below 2 and were rounded by u each, the centre by u, the half and the
  /// ends of a box in it by u of what they are.
  BoundingBox box() const noexcept {
    const Vector3f center = 0.5F * (low_ + high_);
    const Vector3f half = (high_ - center).cwiseMax(center - low_);
    return {center, half + 0x1p-20F * half + Vector3f::Constant(0x1p-22F)};
  }

 private:
  Vector3f low_ = Vector3f::Constant(std::numeric_limits<float>::max());
  Vector3f high_ = Vector3f::Constant(std::numeric_limits<float>::lowest());
};

void add_block(Hull& hull, const TreeParts& parts, std::uint32_t block, const FilterFrame& frame) noexcept {
  const std::size_t begin = std::size_t{block} * tree_width;
  const std::size_t end = std::min(begin + tree_width, parts.triangles.size());
  for (std::size_t at = begin; at < end; ++at) {
    for (const Vec3& corner : parts.triangles[at].corner) {
      const Vector3f point = frame.to_frame(corner).cast<float>();
      hull.add(point, point);
    }
  }
}

/// Returns the boxes of all children, the deepest first, as children come after their parents.
std::vector<BoxesOfNode> boxes_of_all(const TreeParts& parts, const FilterFrame& frame) {
  std::vector<BoxesOfNode> boxes(parts.nodes.size());
  for (std::size_t at = parts.nodes.size(); at-- > 0;) {
    const TreeNode& node = parts.nodes[at];
    for (std::size_t i = 0; i < tree_width; ++i) {
      if (is_empty(node, i)) continue;
      Hull hull;
      const TreeRef child = node.child[i];
      if (child.is_block()) {
        add_block(hull, parts, child.index(), frame);
      } else {
        for (std::size_t k = 0; k < tree_width; ++k)
          if (!is_empty(parts.nodes[child.index()], k)) hull.add(boxes[child.index()][k]);
      }
      boxes[at][i] = hull.box();
    }
  }
  return boxes;
}

/// Sums up what is near the bounds of all children.
struct Volumes {
  double cylinders = 0, boxes = 0;
};

Volumes volumes_within(double margin, const TreeParts& parts,
                       const std::vector<BoxesOfNode>& boxes) noexcept {
  Volumes sum;
  for (std::size_t at = 0; at < parts.nodes.size(); ++at) {
    const TreeNode& node = parts.nodes[at];
    for (std::size_t i = 0; i < tree_width; ++i) {
      if (is_empty(node, i)) continue;
      const double across = double{node.radius[i]} + margin;
      sum.cylinders += pi * across * across * 2 * (double{node.half[i]} + margin);
      sum.boxes += 8 * (boxes[at][i].half.cast<double>().array() + margin).prod();
    }
  }
  return sum;
}

double mean_radius_of_blocks(const TreeParts& parts) noexcept {
  double sum = 0;
  for (const TreeNode& node : parts.nodes) {
    for (std::size_t i = 0; i < tree_width; ++i)
      if (!is_empty(node, i) && node.child[i].is_block()) sum += double{node.radius[i]};
  }
  return sum / static_cast<double>(parts.blocks.size());
}

}  // namespace

BoundingBox box_below(const TreeParts& parts, TreeRef child, const FilterFrame& frame) noexcept {
  Hull hull;
  if (child.is_block()) {
    add_block(hull, parts, child.index(), frame);
  } else {
    const TreeNode& node = parts.nodes[child.index()];
    for (std::size_t i = 0; i < tree_width; ++i)
      if (!is_empty(node, i)) hull.add(box_of(node, i));
  }
  return hull.box();
}

void set_child(TreeNode& node, std::size_t i, const BoundingBox& box) noexcept {
  node.x[i] = box.center.x();
  node.y[i] = box.center.y();
  node.z[i] = box.center.z();
  node.half[i] = box.half.x();
  node.radius[i] = box.half.y();
  node.normal_x[i] = box.half.z();
  node.normal_y[i] = node.normal_z[i] = 0;
}

void choose_bounds(TreeParts& parts, const FilterFrame& frame) {
  const std::vector<BoxesOfNode> boxes = boxes_of_all(parts, frame);
  const Volumes volumes = volumes_within(comparing_margin * mean_radius_of_blocks(parts), parts, boxes);
  parts.boxes = volumes.boxes < volumes.cylinders;
  if (!parts.boxes) return;
  for (std::size_t at = 0; at < parts.nodes.size(); ++at) {
    for (std::size_t i = 0; i < tree_width; ++i)
      if (!is_empty(parts.nodes[at], i)) set_child(parts.nodes[at], i, boxes[at][i]);
  }
}

}  // namespace touchmark::spheres
