#include "core/bvh/build/lazy_builder.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "core/bvh/build/binned_sah.h"
#include "core/bvh/build/bounding_boxes.h"
#include "core/bvh/build/node_splitting.h"
#include "core/bvh/build/node_writer.h"
#include "core/search/threads/parallel.h"

namespace touchmark::bvh {
namespace {

constexpr std::uint32_t max_of_part = UnbuiltParts::part_size, min_of_part = 64, min_parts = 8;
static_assert(max_of_part <= TriangleSplitter::Workspace::capacity);

/// Returns the most triangles of a part: of a small mesh a query is to build a small part.
constexpr std::uint32_t part_size_for(std::size_t triangles) noexcept {
  constexpr std::size_t parts = 16;
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(triangles / parts, min_of_part, max_of_part));
}

/// Returns the most nodes over so many blocks. Of n nodes, all but the root with two blocks at least, those
/// with fewer than eight children have blocks alone, and each of the others has eight: n (1 + 6/8) is at most
/// the number of blocks.
constexpr std::uint32_t max_nodes(std::uint32_t triangles) noexcept {
  const std::uint32_t blocks = (triangles + width - 1) / width;
  return 1 + blocks * 4 / 7;
}

Eigen::Vector3f vector_of(const Lanes& lanes) noexcept { return {lanes[0], lanes[1], lanes[2]}; }

BoundingBox box_of(const TriangleSplitter& splitter, const TriangleRange& range) noexcept {
  const auto [low, high] = splitter.box(range);
  return box_between(vector_of(low), vector_of(high));
}

class TopBuilder {
 public:
  TopBuilder(const TriangleMesh& mesh, const FilterFrame& frame, unsigned threads)
      : mesh_(mesh),
        frame_(frame),
        threads_(threads),
        splitter_(mesh, frame, part_size_for(mesh.size()), threads) {}

  /// Bounds by boxes, whatever serves the mesh better: a cylinder takes a look at all that it is to hold.
  Parts build() {
    add_node(splitter_.all());
    measure_leaves();
    tree_.boxes = true;
    bound();
    leave_parts();
    return std::move(tree_);
  }

 private:
  std::uint32_t add_node(const TriangleRange& range) {
    const auto index = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    add_children(tree_, index, splitter_, range, [&](const TriangleRange& child) {
      if (child.size() > splitter_.smallest()) return ChildRef{add_node(child)};
      ranges_.push_back(child);
      return ChildRef{static_cast<std::uint32_t>(ranges_.size() - 1) | ChildRef::part_bit};
    });
    return index;
  }

  /// Looks at a block of some of the parts.
  void measure_leaves() {
    constexpr std::size_t samples = 32;
    const std::size_t apart = 1 + ranges_.size() / samples;
    double sum = 0;
    std::size_t blocks = 0;
    for (std::size_t i = 0; i < ranges_.size(); i += apart, ++blocks)
      sum += double{box_of(splitter_, splitter_.block_of(ranges_[i])).half.norm()};
    tree_.unbuilt.mean_leaf_radius = sum / static_cast<double>(blocks);
  }

  void bound() {
    constexpr std::size_t parts_a_piece = 16;
    std::vector<BoundingBox> boxes(ranges_.size());
    in_ranges(ranges_.size(), parts_a_piece, threads_, [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) boxes[i] = box_of(splitter_, ranges_[i]);
    });
    // Children come after their parents.
    for (std::size_t at = tree_.nodes.size(); at-- > 0;) {
      Node& node = tree_.nodes[at];
      for (std::size_t i = 0; i < width; ++i) {
        if (node.is_empty(i)) continue;
        const ChildRef child = node.child[i];
        set_child(node, i, child.is_part() ? boxes[child.index()] : box_below(tree_, child, frame_));
      }
    }
  }

  void leave_parts() {
    UnbuiltParts& unbuilt = tree_.unbuilt;
    unbuilt.mesh = std::make_shared<const TriangleMesh>(mesh_);
    unbuilt.frame = frame_;
    unbuilt.states.assign(ranges_.size(), LazyState::unbuilt());
    auto node = static_cast<std::uint32_t>(tree_.nodes.size());
    unbuilt.parts.reserve(ranges_.size());
    for (const TriangleRange& range : ranges_) {
      unbuilt.parts.push_back({range.begin, range.end, node});
      node += max_nodes(range.size());
    }
    tree_.nodes.resize(node);
    tree_.blocks.resize((mesh_.size() + width - 1) / width);
    tree_.triangles.resize(mesh_.size());
    unbuilt.order.resize(mesh_.size());
    for (std::uint32_t i = 0; i < mesh_.size(); ++i) unbuilt.order[i] = splitter_.triangle(i);
  }

  const TriangleMesh& mesh_;
  const FilterFrame& frame_;
  unsigned threads_;
  TriangleSplitter splitter_;
  std::vector<TriangleRange> ranges_;  ///< what the parts hold
  Parts tree_;
};

class PartBuilder {
 public:
  /// Nobody reads yet what is written: the elements of a constant tree's arrays.
  PartBuilder(const Parts& tree, const UnbuiltParts::Part& part) noexcept
      : tree_(const_cast<Parts&>(tree)),
        part_(part),
        triangles_(std::span(tree.unbuilt.order).subspan(part.begin, part.end - part.begin)),
        splitter_(*tree.unbuilt.mesh, triangles_, tree.unbuilt.frame, workspace_),
        next_(part.node) {}

  void build() noexcept {
    const UnbuiltParts& unbuilt = tree_.unbuilt;
    add_node(splitter_.all());
    const auto triangle = [&](std::size_t at) {
      return splitter_.triangle(static_cast<std::uint32_t>(at) - part_.begin);
    };
    for (std::uint32_t at = part_.begin; at < part_.end; at += width)
      set_block(tree_, at / width, *unbuilt.mesh, unbuilt.frame, triangle);
    for (std::uint32_t at = next_; at-- > part_.node;) {
      Node& node = tree_.nodes[at];
      for (std::size_t i = 0; i < width; ++i)
        if (!node.is_empty(i)) set_child(node, i, box_below(tree_, node.child[i], unbuilt.frame));
    }
  }

 private:
  std::uint32_t add_node(const TriangleRange& range) noexcept {
    const std::uint32_t index = next_++;
    add_children(tree_, index, splitter_, range, [&](const TriangleRange& child) {
      return child.size() <= width ? ChildRef{(part_.begin + child.begin) / width | ChildRef::block_bit}
                                   : ChildRef{add_node(child)};
    });
    return index;
  }

  Parts& tree_;
  const UnbuiltParts::Part& part_;
  std::span<const std::uint32_t> triangles_;
  TriangleSplitter::Workspace workspace_;
  TriangleSplitter splitter_;
  std::uint32_t next_;
};

}  // namespace

std::optional<Parts> build_top(const TriangleMesh& mesh, const FilterFrame& frame, unsigned threads) {
  // Fewer are built as quickly.
  if (mesh.size() < min_parts * min_of_part) return std::nullopt;
  return TopBuilder(mesh, frame, threads).build();
}

std::uint32_t built_part(const Parts& tree, std::uint32_t part, Work& work) noexcept {
  const UnbuiltParts::Part& built = tree.unbuilt.parts[part];
  const LazyState& state = tree.unbuilt.states[part];
  while (!state.is_built()) {
    if (state.claim()) {
      PartBuilder(tree, built).build();
      work.triangles += built.end - built.begin;
      state.finish();
    } else {
      std::this_thread::yield();
    }
  }
  return built.node;
}

void build_rest(const Parts& tree, Work& work) noexcept {
  for (std::uint32_t part = 0; part < tree.unbuilt.parts.size(); ++part) built_part(tree, part, work);
}

}  // namespace touchmark::bvh
