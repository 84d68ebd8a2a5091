/// Splits ranges of triangles for the hierarchy, by the surface area heuristic over bins.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/bvh/clusters.h"
#include "core/bvh/node.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/simd/lanes.h"
#include "core/triangle_mesh.h"

namespace touchmark::bvh {

/// Triangles [begin, end) of the splitter's order, after `depth` splits.
struct TriangleRange {
  std::uint32_t begin = 0, end = 0;
  std::uint32_t depth = 0;
  std::uint32_t number = 0;  ///< the split's, parents before their children

  std::uint32_t size() const noexcept { return end - begin; }
  /// Returns the place in the range that leaves about so many triangles on the left, in whole blocks. The
  /// range must hold more than one block.
  std::uint32_t whole_blocks(std::uint32_t left) const noexcept {
    const std::uint32_t blocks = (left + width / 2) / width;
    const std::uint32_t max_blocks = (size() - 1) / width;
    return begin + width * std::clamp(blocks, 1U, max_blocks);
  }
};

/// Puts triangles in an order in which they are split again and again, until each range is a block.
class TriangleSplitter {
 public:
  /// After this many splits ranges are halved.
  static constexpr std::uint32_t max_uneven_splits = 40;
  /// So no range of 2^32 triangles is deeper.
  static constexpr std::uint32_t deepest = max_uneven_splits + 32;

  TriangleSplitter(const TriangleMesh& mesh, const Clusters& clusters, const FilterFrame& frame,
                   unsigned threads);
  /// Splits without clusters, until ranges are at most so long, a multiple of a block.
  TriangleSplitter(const TriangleMesh& mesh, const FilterFrame& frame, std::uint32_t smallest,
                   unsigned threads);
  struct Workspace;
  /// Splits some of a mesh's triangles in memory of the caller's, which has room for them.
  TriangleSplitter(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
                   const FilterFrame& frame, Workspace& workspace) noexcept;
  TriangleSplitter(const TriangleSplitter&) = delete;
  TriangleSplitter& operator=(const TriangleSplitter&) = delete;

  std::uint32_t smallest() const noexcept { return smallest_; }
  /// Splits a range on, here and there, until it is a block.
  TriangleRange block_of(TriangleRange range);
  /// Returns the box of a range's triangles, their corners rounded to the nearest.
  std::pair<Lanes, Lanes> box(const TriangleRange& range) const noexcept;

  TriangleRange all() const noexcept { return {0, static_cast<std::uint32_t>(items_.size()), 0, 0}; }
  /// The mesh's triangle at a position in the order.
  std::uint32_t triangle(std::uint32_t position) const noexcept { return items_[position].triangle; }
  // What follows is asked of `all` and what it is split into; the range must hold more than one block.
  /// Returns about half of the area of the range's box, a measure of how often a search looks into it.
  float area(const TriangleRange& range) const noexcept { return splits_[range.number].area; }
  /// The left part holds whole blocks.
  std::pair<TriangleRange, TriangleRange> halves(const TriangleRange& range) const noexcept;

 private:
  /// In the frame; the last lane is 0.
  struct Box {
    Lanes min, max;
  };
  /// A triangle's box, and between its corners what would be padding.
  struct Item {
    std::array<float, 3> min;
    std::uint32_t triangle;
    std::array<float, 3> max;
    std::uint32_t cluster;
  };
  /// What triangles are told apart by: the middle of the cluster or of the triangle's own box, times two.
  enum class Key { cluster, triangle };
  /// Left of bin `bin` along the axis.
  struct Cut {
    int axis;
    std::size_t bin;
  };
  /// Cuts a box in bins along each axis.
  struct Bins {
    Lanes origin, scale;
  };

  struct Split {
    float area;
    std::uint32_t middle;  ///< the first triangle of the right part
  };
  /// What a sample of a range lies in, and its boxes' middles, times two.
  struct Bounds {
    Box all, middles;
  };

  static Item item_of(const TriangleMesh& mesh, std::uint32_t triangle, const FilterFrame& frame,
                      std::uint32_t cluster) noexcept;
  void add_items(const TriangleMesh& mesh, const FilterFrame& frame, unsigned threads);
  void add_items(const TriangleMesh& mesh, const Clusters& clusters, const FilterFrame& frame,
                 std::size_t first, std::size_t end);
  void split_all(unsigned threads);
  std::pair<TriangleRange, TriangleRange> split(const TriangleRange& range);
  void split_to_smallest(const TriangleRange& range);
  Bounds bounds_of(const TriangleRange& range) const noexcept;
  /// A cut is chosen by every item of a short range, and by so many of a long one, or twice as many.
  std::uint32_t mean_step(const TriangleRange& range) const noexcept {
    const std::uint32_t least = smallest_ > width ? 192 : 1024;
    return std::max(range.size() / least, 1U);
  }
  static Box box_of(const Item& item) noexcept;
  Lanes key_of(const Item& item, Key key) const noexcept;
  float key_of(const Item& item, Key key, int axis) const noexcept;
  Box cluster_bounds(const TriangleRange& range) const noexcept;
  std::optional<Cut> cheapest_cut(const TriangleRange& range, Key key, const Bins& bins) const noexcept;
  std::uint32_t partition_at(const TriangleRange& range, Key key, const Bins& bins, const Cut& cut);
  void halve(const TriangleRange& range, std::uint32_t position, Key key, int axis);

  std::uint32_t smallest_ = width;
  std::vector<Item> own_items_, own_scratch_;
  std::vector<Split> own_splits_;
  std::span<Item> items_;
  std::span<Item> scratch_;          ///< room for as many
  std::vector<Lanes> cluster_keys_;  ///< empty when every triangle is its own cluster
  std::span<Split> splits_;          ///< by number; one less than there are blocks
};

struct TriangleSplitter::Workspace {
  static constexpr std::size_t capacity = 512;  ///< triangles

  std::array<Item, capacity> items, scratch;
  std::array<Split, capacity / width> splits;
};

}  // namespace touchmark::bvh
