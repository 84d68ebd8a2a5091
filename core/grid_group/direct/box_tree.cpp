#include "core/grid_group/direct/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/search/threads/parallel.h"

namespace touchmark::grid {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

struct FloatBox {
  std::array<float, 3> min = {infinity, infinity, infinity};
  std::array<float, 3> max = {-infinity, -infinity, -infinity};

  /// Widens the box by as much as rounding to the nearest may have taken off.
  void round_outward() noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      min[k] = std::nextafter(min[k], -infinity);
      max[k] = std::nextafter(max[k], infinity);
    }
  }
  void extend(const FloatBox& other) noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      min[k] = std::min(min[k], other.min[k]);
      max[k] = std::max(max[k], other.max[k]);
    }
  }
};

/// Returns the box of the corners, each rounded to the nearest float.
FloatBox box_of(const PreparedTriangle& triangle, const FilterFrame& frame) noexcept {
  FloatBox box;
  for (const Vec3& corner : triangle.corner) {
    const Vec3 p = frame.scale() * (corner - frame.origin());
    for (std::size_t k = 0; k < 3; ++k) {
      const auto rounded = static_cast<float>(p[static_cast<int>(k)]);
      box.min[k] = std::min(box.min[k], rounded);
      box.max[k] = std::max(box.max[k], rounded);
    }
  }
  return box;
}

std::vector<FloatBox> block_boxes(const TriangleStore& store, unsigned threads) {
  constexpr std::size_t blocks_a_piece = 128;
  std::vector<FloatBox> boxes(store.planes.size() / TriangleStore::block_size);
  in_ranges(boxes.size(), blocks_a_piece, threads, [&](std::size_t first, std::size_t end) {
    for (std::size_t block = first; block < end; ++block) {
      const std::size_t slot = block * TriangleStore::block_size;
      for (std::size_t i = slot; i < std::min<std::size_t>(slot + TriangleStore::block_size, store.size());
           ++i)
        boxes[block].extend(box_of(store.exact[i], store.frame));
      boxes[block].round_outward();
    }
  });
  return boxes;
}

EightBoxes node_over(const std::vector<FloatBox>& children, std::size_t first) noexcept {
  EightBoxes node;
  for (std::size_t i = 0; i < BoxTree::arity; ++i) {
    const FloatBox box = first + i < children.size() ? children[first + i] : FloatBox();
    for (std::size_t k = 0; k < 3; ++k) {
      node.min[k][i / 4][i % 4] = box.min[k];
      node.max[k][i / 4][i % 4] = box.max[k];
    }
  }
  return node;
}

}  // namespace

BoxTree::BoxTree(const TriangleStore& store, unsigned threads) {
  std::vector<FloatBox> children = block_boxes(store, threads);
  do {
    first_.push_back(nodes_.size());
    std::vector<FloatBox> parents((children.size() + arity - 1) / arity);
    for (std::size_t i = 0; i < children.size(); ++i) parents[i / arity].extend(children[i]);
    for (std::size_t i = 0; i < parents.size(); ++i) nodes_.push_back(node_over(children, i * arity));
    children = std::move(parents);
  } while (children.size() > 1);
}

}  // namespace touchmark::grid
