#include "core/bvh/build/bounding_boxes.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/bvh/build/bounding_cylinder.h"
#include "core/bvh/build/node_writer.h"
#include "core/search/threads/parallel.h"

namespace touchmark::bvh {
namespace {

using Eigen::Vector3f;
constexpr double pi = 3.14159;

/// From how far off bounds are compared, in mean radii of the blocks' cylinders.
constexpr double comparing_margin = 0.5;
/// How many times the volume of cylinders boxes may have: they are tested in fewer instructions, and fill the
/// upper levels better than the blocks.
constexpr double max_volume = 1.6;

BoundingBox box_of(const Node& node, std::size_t i) noexcept {
  return {{node.x()[i], node.y()[i], node.z()[i]}, {node.half_x()[i], node.half_y()[i], node.half_z()[i]}};
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

void add_block(Hull& hull, const Parts& parts, std::uint32_t block, const FilterFrame& frame) noexcept {
  const std::size_t begin = std::size_t{block} * width;
  const std::size_t end = std::min(begin + width, parts.triangles.size());
  for (std::size_t at = begin; at < end; ++at) {
    for (const Vec3& corner : parts.triangles[at].corner) {
      const Vector3f point = frame.to_frame(corner).cast<float>();
      hull.add(point, point);
    }
  }
}

/// Bounds of the same blocks.
struct BothBounds {
  std::vector<BoundingCylinder> cylinders;
  std::vector<BoundingBox> boxes;
};

/// Bounds the blocks below some nodes, about so many or all, evenly among the others.
BothBounds sampled_bounds(const Parts& parts, const TriangleMesh& mesh, const FilterFrame& frame) {
  constexpr std::size_t fewest = 256, max_apart = 8;
  const std::size_t apart = std::clamp<std::size_t>(parts.nodes.size() / fewest, 1, max_apart);
  BoundOfTriangles around(mesh, frame);
  BothBounds bounds;
  for (std::size_t at = 0; at < parts.nodes.size(); at += apart) {
    const Node& node = parts.nodes[at];
    for (std::size_t i = 0; i < width; ++i) {
      if (node.is_empty(i) || !node.child[i].is_block()) continue;
      const std::size_t begin = std::size_t{node.child[i].index()} * width;
      for (std::size_t k = begin; k < std::min(begin + width, parts.triangles.size()); ++k)
        around.add(parts.triangles[k].index);
      bounds.cylinders.push_back(around.bound());
      bounds.boxes.push_back(box_below(parts, node.child[i], frame));
    }
  }
  return bounds;
}

}  // namespace

BoundingBox box_below(const Parts& parts, ChildRef child, const FilterFrame& frame) noexcept {
  Hull hull;
  if (child.is_block()) {
    add_block(hull, parts, child.index(), frame);
  } else {
    const Node& node = parts.nodes[child.index()];
    for (std::size_t i = 0; i < width; ++i)
      if (!node.is_empty(i)) hull.add(box_of(node, i));
  }
  return hull.box();
}

void set_child(Node& node, std::size_t i, const BoundingBox& box) noexcept {
  node.set_box(i, box.center, box.half);
}

BoundingBox box_between(const Vector3f& low, const Vector3f& high) noexcept {
  Hull hull;
  hull.add(low, high);
  return hull.box();
}

bool boxes_serve_better(const Parts& parts, const TriangleMesh& mesh, const FilterFrame& frame) {
  const BothBounds bounds = sampled_bounds(parts, mesh, frame);
  double margin = 0;
  for (const BoundingCylinder& one : bounds.cylinders) margin += double{one.radius};
  margin *= comparing_margin / static_cast<double>(std::max<std::size_t>(bounds.cylinders.size(), 1));
  // What is near the bounds of all.
  double in_cylinders = 0, in_boxes = 0;
  for (const BoundingCylinder& one : bounds.cylinders) {
    const double across = double{one.radius} + margin;
    in_cylinders += pi * across * across * 2 * (double{one.half} + margin);
  }
  for (const BoundingBox& one : bounds.boxes)
    in_boxes += 8 * (one.half.cast<double>().array() + margin).prod();
  return in_boxes <= max_volume * in_cylinders;
}

void bound_by_boxes(Parts& parts, const FilterFrame& frame, unsigned threads) {
  const auto bound = [&](std::size_t at, bool blocks) {
    Node& node = parts.nodes[at];
    for (std::size_t i = 0; i < width; ++i)
      if (!node.is_empty(i) && node.child[i].is_block() == blocks)
        set_child(node, i, box_below(parts, node.child[i], frame));
  };
  constexpr std::size_t nodes_a_piece = 64;
  in_ranges(parts.nodes.size(), nodes_a_piece, threads, [&](std::size_t first, std::size_t end) {
    for (std::size_t at = first; at < end; ++at) bound(at, true);
  });
  // Children come after their parents.
  for (std::size_t at = parts.nodes.size(); at-- > 0;) bound(at, false);
}

}  // namespace touchmark::bvh
