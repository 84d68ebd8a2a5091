#include "core/sphere_cluster/tree/builder.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/sphere_cluster/tree/binned_sah.h"
#include "core/sphere_cluster/tree/node_writer.h"

namespace touchmark::spheres {
namespace {

class Builder {
 public:
  Builder(const TriangleMesh& mesh, const SphereClusters& clusters, const FilterFrame& frame)
      : mesh_(mesh), frame_(frame), splitter_(mesh, clusters, frame), bound_(mesh, frame) {}

  TreeParts build() {
    TreeParts parts;
    parts_ = &parts;
    const auto count = static_cast<std::uint32_t>(mesh_.size());
    parts.triangles.reserve(mesh_.size());
    parts.blocks.reserve(mesh_.size() / tree_width + 1);
    add_node({0, count, 0});
    parts.nodes.shrink_to_fit();
    return parts;
  }

 private:
  std::uint32_t add_node(TriangleRange range) {
    const auto index = static_cast<std::uint32_t>(parts_->nodes.size());
    parts_->nodes.emplace_back();
    std::array<TriangleRange, tree_width> children;
    const std::size_t count = split_into(range, children);
    for (std::size_t i = count; i < tree_width; ++i) parts_->nodes[index].clear(i);
    for (std::size_t i = 0; i < count; ++i) {
      set_child(parts_->nodes[index], i, bound(children[i]));
      const TreeRef child = children[i].size() <= tree_width
                                ? TreeRef{add_block(children[i]) | TreeRef::block_bit}
                                : TreeRef{add_node(children[i])};
      parts_->nodes[index].child[i] = child;
    }
    return index;
  }

  /// Splits the range that is most likely to be looked into, again and again.
  std::size_t split_into(TriangleRange range, std::array<TriangleRange, tree_width>& children) {
    std::array<float, tree_width> area;
    // Of a range that is a block already nobody asks.
    const auto area_of = [&](const TriangleRange& r) {
      return r.size() > tree_width ? splitter_.area(r) : 0.0F;
    };
    children[0] = range;
    area[0] = area_of(range);
    std::size_t count = 1;
    while (count < tree_width) {
      std::size_t widest = count;
      for (std::size_t i = 0; i < count; ++i)
        if (children[i].size() > tree_width && (widest == count || area[i] > area[widest])) widest = i;
      if (widest == count) break;
      const auto [left, right] = splitter_.split(children[widest]);
      children[widest] = left;
      children[count] = right;
      area[widest] = area_of(left);
      area[count] = area_of(right);
      ++count;
    }
    // In the splitter's order, so that the last block is the one that need not be full.
    std::sort(children.begin(), children.begin() + count,
              [](const TriangleRange& a, const TriangleRange& b) { return a.begin < b.begin; });
    return count;
  }

  BoundingCylinder bound(const TriangleRange& range) {
    for (std::uint32_t i = range.begin; i < range.end; ++i) bound_.add(splitter_.triangle(i));
    return bound_.bound();
  }

  std::uint32_t add_block(const TriangleRange& range) {
    const auto index = static_cast<std::uint32_t>(parts_->blocks.size());
    TriangleBlock block{};
    std::fill(std::begin(block.offset[0]), std::end(block.offset[0]), std::numeric_limits<float>::max());
    for (std::uint32_t i = 0; i < range.size(); ++i) {
      parts_->triangles.push_back(prepare(mesh_, splitter_.triangle(range.begin + i)));
      set_triangle(block, i, planes_of(parts_->triangles.back(), frame_));
    }
    parts_->blocks.push_back(block);
    return index;
  }

  const TriangleMesh& mesh_;
  const FilterFrame& frame_;
  TriangleSplitter splitter_;
  TreeParts* parts_ = nullptr;
  BoundOfTriangles bound_;
};

}  // namespace

TreeParts build_tree(const TriangleMesh& mesh, const SphereClusters& clusters, const FilterFrame& frame) {
  return Builder(mesh, clusters, frame).build();
}

}  // namespace touchmark::spheres
