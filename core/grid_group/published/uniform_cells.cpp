#include "core/grid_group/published/uniform_cells.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/triangle_box.h"

namespace touchmark::grid {
namespace {

constexpr std::uint32_t max_along_axis = 1u << 20;  // three of them number a cell within 64 bits

}  // namespace

UniformCells::UniformCells(const Aabb& box, double edge) noexcept
    : origin_(box.min), edge_(std::max(edge, box.extent().maxCoeff() / (max_along_axis - 1))) {
  for (int k = 0; k < 3; ++k) {
    const double cells = std::floor(box.extent()[k] / edge_) + 1;
    count_[static_cast<std::size_t>(k)] =
        static_cast<std::uint32_t>(std::min(cells, static_cast<double>(max_along_axis)));
  }
}

std::uint32_t UniformCells::along(int axis, double coordinate) const noexcept {
  const double cell = std::floor((coordinate - origin_[axis]) / edge_);
  return static_cast<std::uint32_t>(std::clamp(cell, 0.0, count_[static_cast<std::size_t>(axis)] - 1.0));
}

Aabb UniformCells::box(const std::array<std::uint32_t, 3>& cell) const noexcept {
  const Vec3 low = origin_ + edge_ * Vec3(cell[0], cell[1], cell[2]);
  return {low, low + Vec3::Constant(edge_)};
}

UniformCells::Range UniformCells::range_of(const TriangleMesh& mesh, std::uint32_t triangle) const noexcept {
  Aabb bounds;
  for (int i = 0; i < 3; ++i) bounds.extend(mesh.corner(triangle, i));
  Range range{};
  for (int k = 0; k < 3; ++k) {
    range.first[static_cast<std::size_t>(k)] = along(k, bounds.min[k]);
    range.last[static_cast<std::size_t>(k)] = along(k, bounds.max[k]);
  }
  return range;
}

std::uint64_t UniformCells::covered_by_box_of(const TriangleMesh& mesh,
                                              std::uint32_t triangle) const noexcept {
  const Range range = range_of(mesh, triangle);
  std::uint64_t covered = 1;
  for (std::size_t k = 0; k < 3; ++k) covered *= range.last[k] - range.first[k] + 1;
  return covered;
}

void UniformCells::append_cells_of(const TriangleMesh& mesh, std::uint32_t triangle,
                                   std::vector<Membership>& memberships) const {
  const Range range = range_of(mesh, triangle);
  const bool within_one = range.first == range.last;
  const std::size_t before = memberships.size();
  const std::array<Vec3, 3> corners = {mesh.corner(triangle, 0), mesh.corner(triangle, 1),
                                       mesh.corner(triangle, 2)};
  std::array<std::uint32_t, 3> cell{};
  for (cell[2] = range.first[2]; cell[2] <= range.last[2]; ++cell[2])
    for (cell[1] = range.first[1]; cell[1] <= range.last[1]; ++cell[1])
      for (cell[0] = range.first[0]; cell[0] <= range.last[0]; ++cell[0])
        if (within_one || overlaps(corners, box(cell))) memberships.push_back({number(cell), triangle});
  // Where the coordinates' own rounding exceeds a cell, the test may find none: it belongs to one all the
  // same.
  if (memberships.size() == before) memberships.push_back({number(range.first), triangle});
}

}  // namespace touchmark::grid
