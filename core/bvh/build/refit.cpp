#include "core/bvh/build/refit.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/bvh/build/bounding_boxes.h"
#include "core/bvh/build/node_writer.h"

namespace touchmark::bvh {
namespace {

/// As many neighbours in the tree's order share a box of what was moved.
constexpr std::uint32_t blocks_a_box = 64;

class Refit {
 public:
  Refit(Parts& parts, const TriangleMesh& mesh, const FilterFrame& frame)
      : parts_(parts),
        mesh_(mesh),
        frame_(frame),
        bound_(mesh, frame),
        block_moved_(parts.blocks.size(), false),
        nodes_(parts.nodes.size()) {}

  MovedTriangles run() {
    for (std::uint32_t first = 0; first < parts_.blocks.size(); first += blocks_a_box) {
      Aabb box;
      const auto end = std::min(first + blocks_a_box, static_cast<std::uint32_t>(parts_.blocks.size()));
      for (std::uint32_t block = first; block < end; ++block) move_block(block, box);
      if (!box.empty()) moved_.boxes.push_back(box);
    }
    // Children come after their parents.
    for (std::size_t node = parts_.nodes.size(); moved_.count > 0 && node-- > 0;) fit_node(node);
    return std::move(moved_);
  }

 private:
  /// What is below a node or a child: triangles that follow one another.
  struct Below {
    std::uint32_t begin = std::numeric_limits<std::uint32_t>::max(), end = 0;
    bool moved = false;
  };

  void move_block(std::uint32_t block, Aabb& box) {
    const Below range = below_block(block);
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      PreparedTriangle& triangle = parts_.triangles[i];
      if (!has_moved(triangle, mesh_)) continue;
      for (const Vec3& corner : triangle.corner) box.extend(corner);
      triangle = prepare(mesh_, triangle.index);
      for (const Vec3& corner : triangle.corner) box.extend(corner);
      set_triangle(parts_.blocks[block], i - range.begin, planes_of(triangle, frame_));
      block_moved_[block] = true;
      ++moved_.count;
    }
  }

  void fit_node(std::size_t index) {
    Node& node = parts_.nodes[index];
    Below& all = nodes_[index];
    for (std::size_t i = 0; i < width; ++i) {
      if (node.is_empty(i)) continue;
      const ChildRef child = node.child[i];
      const Below below = child.is_block() ? below_block(child.index()) : nodes_[child.index()];
      if (below.moved && !parts_.boxes) set_child(node, i, bound_of(below));
      if (below.moved && parts_.boxes) set_child(node, i, box_below(parts_, child, frame_));
      all = {std::min(all.begin, below.begin), std::max(all.end, below.end), all.moved || below.moved};
    }
  }

  Below below_block(std::uint32_t block) const {
    const auto count = static_cast<std::uint32_t>(parts_.triangles.size());
    return {block * width, std::min((block + 1) * width, count), block_moved_[block]};
  }

  BoundingCylinder bound_of(const Below& range) {
    for (std::uint32_t i = range.begin; i < range.end; ++i) bound_.add(parts_.triangles[i].index);
    return bound_.bound();
  }

  Parts& parts_;
  const TriangleMesh& mesh_;
  const FilterFrame& frame_;
  BoundOfTriangles bound_;
  std::vector<bool> block_moved_;
  std::vector<Below> nodes_;
  MovedTriangles moved_;
};

}  // namespace

MovedTriangles refit_tree(Parts& parts, const TriangleMesh& mesh, const FilterFrame& frame) {
  return Refit(parts, mesh, frame).run();
}

}  // namespace touchmark::bvh
