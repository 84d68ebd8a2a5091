/// Splits ranges of triangles for the hierarchy, by the surface area heuristic over bins.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/search/plane_filter.h"
#include "core/simd/lanes.h"
#include "core/sphere_cluster/clustering.h"
#include "core/triangle_mesh.h"

namespace touchmark::spheres {

/// Triangles [begin, end) of the splitter's order, after `depth` splits.
struct TriangleRange {
  std::uint32_t begin, end;
  std::uint32_t depth;

  std::uint32_t size() const noexcept { return end - begin; }
};

class TriangleSplitter {
 public:
  /// After this many splits ranges are halved.
  static constexpr std::uint32_t max_uneven_splits = 40;
  /// So no range of 2^32 triangles is deeper.
  static constexpr std::uint32_t deepest = max_uneven_splits + 32;

  TriangleSplitter(const TriangleMesh& mesh, const SphereClusters& clusters, const FilterFrame& frame);

  /// The mesh's triangle at a position in the order.
  std::uint32_t triangle(std::uint32_t position) const noexcept { return items_[position].triangle; }
  /// Returns half of the area of the range's box, a measure of how often a search looks into it.
  float area(const TriangleRange& range) const noexcept;
  /// The left part holds whole blocks. The range must hold more than one block.
  std::pair<TriangleRange, TriangleRange> split(const TriangleRange& range);

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
    std::uint32_t left;  ///< triangles
  };
  /// Cuts a box in bins along each axis.
  struct Bins {
    Lanes origin, scale;
  };

  static Box box_of(const Item& item) noexcept;
  Lanes key_of(const Item& item, Key key) const noexcept;
  float key_of(const Item& item, Key key, int axis) const noexcept;
  Box key_bounds(const TriangleRange& range, Key key) const noexcept;
  std::optional<Cut> cheapest_cut(const TriangleRange& range, Key key, const Bins& bins) const noexcept;
  void partition_at(const TriangleRange& range, std::uint32_t position, Key key, const Bins& bins,
                    const Cut& cut);
  void halve(const TriangleRange& range, std::uint32_t position, Key key, int axis);

  std::vector<Item> items_;
  std::vector<Item> scratch_;        ///< room for as many
  std::vector<Lanes> cluster_keys_;  ///< empty when every triangle is its own cluster
};

}  // namespace touchmark::spheres
