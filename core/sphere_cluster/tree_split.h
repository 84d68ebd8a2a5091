/// Splits ranges of triangles for the hierarchy, by the surface area heuristic over bins.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/plane_filter.h"
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
  /// Past this many splits ranges are halved.
  static constexpr std::uint32_t most_uneven_splits = 40;
  /// So no range of 2^32 triangles is deeper.
  static constexpr std::uint32_t deepest = most_uneven_splits + 32;

  TriangleSplitter(const TriangleMesh& mesh, const SphereClusters& clusters, const FilterFrame& frame);

  /// The mesh's triangle at a place in the order.
  std::uint32_t triangle(std::uint32_t place) const noexcept { return items_[place].triangle; }
  /// Of the range's box, as a measure of how often a search looks into it.
  float area(const TriangleRange& range) const noexcept;
  /// The left part holds whole blocks. The range must hold more than one block.
  std::pair<TriangleRange, TriangleRange> split(const TriangleRange& range);

 private:
  struct Box {
    Eigen::Array3f min, max;
  };
  struct Item {
    Eigen::Array3f key;     // the cluster's centre
    Eigen::Array3f center;  // the triangle's
    Box box;
    std::uint32_t triangle;
  };

  using Point = Eigen::Array3f Item::*;
  struct Cut {
    int axis;
    std::uint32_t left;  // triangles
  };

  Box spread(const TriangleRange& range, Point point) const noexcept;
  void part_at(const TriangleRange& range, std::uint32_t place, Point point, int axis);
  std::optional<Cut> cheapest_cut(const TriangleRange& range, Point point, const Box& box) const noexcept;

  std::vector<Item> items_;
};

}  // namespace touchmark::spheres
