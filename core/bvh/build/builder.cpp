#include "core/bvh/build/builder.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/bvh/build/binned_sah.h"
#include "core/bvh/build/bounding_boxes.h"
#include "core/bvh/build/node_splitting.h"
#include "core/bvh/build/node_writer.h"
#include "core/search/threads/parallel.h"

namespace touchmark::bvh {
namespace {

class Builder {
 public:
  Builder(const TriangleMesh& mesh, const Clusters* clusters, const FilterFrame& frame, unsigned threads)
      : mesh_(mesh),
        frame_(frame),
        threads_(threads),
        splitter_(clusters != nullptr ? TriangleSplitter(mesh, *clusters, frame, threads)
                                      : TriangleSplitter(mesh, frame, width, threads)) {}

  Parts build() {
    add_node(splitter_.all());
    parts_.nodes.shrink_to_fit();
    add_blocks();
    parts_.boxes = boxes_serve_better(parts_, mesh_, frame_);
    if (parts_.boxes)
      bound_by_boxes(parts_, frame_, threads_);
    else
      bound_by_cylinders();
    return std::move(parts_);
  }

 private:
  /// A child whose bound is still to be found.
  struct Child {
    std::uint32_t node, i;
    std::uint32_t begin, end;  ///< triangles of the splitter's order
  };

  std::uint32_t add_node(TriangleRange range) {
    const auto index = static_cast<std::uint32_t>(parts_.nodes.size());
    parts_.nodes.emplace_back();
    std::uint32_t i = 0;
    add_children(parts_, index, splitter_, range, [&](const TriangleRange& child) {
      children_.push_back({index, i++, child.begin, child.end});
      // Blocks are in the splitter's order, and begin where one would if all were full.
      return child.size() <= width ? ChildRef{child.begin / width | ChildRef::block_bit}
                                   : ChildRef{add_node(child)};
    });
    return index;
  }

  void bound_by_cylinders() {
    std::vector<std::size_t> first;  // child of each piece of the work
    constexpr std::uint32_t triangles_a_piece = 2048;
    std::uint32_t triangles = triangles_a_piece;
    for (std::size_t i = 0; i < children_.size(); ++i) {
      if (triangles >= triangles_a_piece) {
        first.push_back(i);
        triangles = 0;
      }
      triangles += children_[i].end - children_[i].begin;
    }
    const std::size_t pieces = first.size();
    first.push_back(children_.size());
    std::vector<BoundOfTriangles> bounds(std::min<std::size_t>(threads_, pieces), {mesh_, frame_});
    in_parallel(pieces, threads_, [&](unsigned thread, std::size_t piece) {
      BoundOfTriangles& bound = bounds[thread];
      for (std::size_t child = first[piece]; child < first[piece + 1]; ++child) {
        const auto& [node, i, begin, end] = children_[child];
        for (std::uint32_t at = begin; at < end; ++at) bound.add(splitter_.triangle(at));
        set_child(parts_.nodes[node], i, bound.bound());
      }
    });
  }

  void add_blocks() {
    constexpr std::size_t blocks_a_piece = 64;
    parts_.triangles.resize(mesh_.size());
    parts_.blocks.resize((mesh_.size() + width - 1) / width);
    in_ranges(parts_.blocks.size(), blocks_a_piece, threads_, [&](std::size_t first, std::size_t end) {
      for (std::size_t block = first; block < end; ++block)
        set_block(parts_, block, mesh_, frame_,
                  [&](std::size_t at) { return splitter_.triangle(static_cast<std::uint32_t>(at)); });
    });
  }

  const TriangleMesh& mesh_;
  const FilterFrame& frame_;
  unsigned threads_;
  TriangleSplitter splitter_;
  Parts parts_;
  std::vector<Child> children_;  ///< parents before their children
};

}  // namespace

Parts build_tree(const TriangleMesh& mesh, const Clusters* clusters, const FilterFrame& frame,
                 unsigned threads) {
  return Builder(mesh, clusters, frame, threads).build();
}

}  // namespace touchmark::bvh
