/// Cubic cells over a box, and which of them a triangle touches.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/aabb.h"
#include "core/triangle_mesh.h"

namespace touchmark::grid {

/// A triangle in a cell; sorted, they are the cells' lists.
struct Membership {
  std::uint64_t cell;
  std::uint32_t triangle;

  auto operator<=>(const Membership&) const = default;
};

/// Cells are numbered x fastest; a point on a border belongs to the cell above it, on the far side of the box
/// to the last.
class UniformCells {
 public:
  /// `edge` > 0, the box finite. At most 2^20 cells an axis: a smaller edge is made larger.
  UniformCells(const Aabb& box, double edge) noexcept;

  double edge() const noexcept { return edge_; }
  std::uint64_t number(const std::array<std::uint32_t, 3>& cell) const noexcept {
    return (static_cast<std::uint64_t>(cell[2]) * count_[1] + cell[1]) * count_[0] + cell[0];
  }
  /// The cell of a coordinate along an axis; outside the box, the nearest cell.
  std::uint32_t along(int axis, double coordinate) const noexcept;
  Aabb box(const std::array<std::uint32_t, 3>& cell) const noexcept;

  /// Cells that the triangle's own box overlaps: a bound on those it touches.
  std::uint64_t covered_by_box_of(const TriangleMesh& mesh, std::uint32_t triangle) const noexcept;
  /// Appends a membership for each cell that the triangle touches.
  void append_cells_of(const TriangleMesh& mesh, std::uint32_t triangle,
                       std::vector<Membership>& memberships) const;

 private:
  struct Range {
    std::array<std::uint32_t, 3> first, last;
  };
  Range range_of(const TriangleMesh& mesh, std::uint32_t triangle) const noexcept;

  Vec3 origin_;
  double edge_;
  std::array<std::uint32_t, 3> count_{};
};

}  // namespace touchmark::grid
