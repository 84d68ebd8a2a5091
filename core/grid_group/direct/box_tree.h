/// A hierarchy of boxes over the blocks of a TriangleStore: eight children a node, no pointers. It serves the
/// probes that no cell covers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/grid_group/direct/triangle_store.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/simd/lanes.h"

namespace touchmark::grid {

/// Eight boxes in the filter's frame, rounded outward; a child that does not exist is infinitely far.
struct alignas(64) EightBoxes {
  Lanes min[3][2], max[3][2];
};

class BoxTree {
 public:
  static constexpr std::uint32_t arity = 8;

  BoxTree() = default;
  explicit BoxTree(const TriangleStore& store, unsigned threads = 1);

  /// Level 0's nodes have blocks as children, level k's those of level k - 1; the last level is one node.
  std::size_t levels() const noexcept { return first_.size(); }
  const EightBoxes& node(std::size_t level, std::uint32_t index) const noexcept {
    return nodes_[first_[level] + index];
  }
  std::size_t bytes() const noexcept {
    return nodes_.capacity() * sizeof(EightBoxes) + first_.capacity() * sizeof(std::size_t);
  }

 private:
  std::vector<EightBoxes> nodes_;
  std::vector<std::size_t> first_;  ///< index of each level's first node
};

/// Lower bounds of the squared distances to eight boxes, in the frame, as safe as the plane filter's.
inline std::array<Lanes, 2> lower_bounds(const EightBoxes& boxes, const FilterPoint& p) noexcept {
  const std::array<float, 3> point = {p.x, p.y, p.z};
  const Lanes zero = {0, 0, 0, 0};
  std::array<Lanes, 2> squared = {zero, zero};
  for (std::size_t half = 0; half < 2; ++half) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Lanes outside = simd::max(boxes.min[k][half] - point[k], point[k] - boxes.max[k][half]);
      const Lanes excess = simd::max(outside - p.plane_error, zero);
      squared[half] += excess * excess;
    }
  }
  return squared;
}

/// Nodes still to be visited, nearest on top. Seven siblings a level wait at most, and the last level's
/// eight.
class BoxStack {
 public:
  struct Entry {
    float bound;
    std::uint32_t index;
    std::uint32_t level;  ///< 0: a block
  };

  bool empty() const noexcept { return size_ == 0; }
  Entry pop() noexcept { return entries_[--size_]; }
  std::size_t size() const noexcept { return size_; }
  std::span<const Entry> from(std::size_t base) const noexcept {
    return {entries_.data() + base, size_ - base};
  }
  /// Keeps the entries from `base` on in order, the least bound on top.
  void insert(std::size_t base, const Entry& entry) noexcept {
    std::size_t at = size_++;
    for (; at > base && entries_[at - 1].bound < entry.bound; --at) entries_[at] = entries_[at - 1];
    entries_[at] = entry;
  }
  /// The children of a node that are within the limit, farthest first.
  void push(const std::array<Lanes, 2>& bounds, float limit, std::uint32_t node,
            std::uint32_t level) noexcept {
    const std::size_t base = size_;
    for (std::uint32_t half = 0; half < 2; ++half) {
      for (unsigned left = at_most(bounds[half], limit); left != 0; left &= left - 1) {
        const auto lane = static_cast<std::uint32_t>(__builtin_ctz(left));
        insert(base, {bounds[half][lane], node * BoxTree::arity + 4 * half + lane, level});
      }
    }
  }

 private:
  // 2^32 triangles are 2^29 blocks: ten levels.
  std::array<Entry, 8 * 11> entries_;
  std::size_t size_ = 0;
};

}  // namespace touchmark::grid
