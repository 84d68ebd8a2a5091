/// The mesh's triangles as the direct form keeps them: near in space, near in memory, eight to a block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/plane_filter.h"
#include "core/geometry/point_triangle.h"
#include "core/triangle_mesh.h"

namespace touchmark::grid {

/// Places are positions in the order of a Morton curve through the centroids; `exact[place].index` is the
/// position in the mesh. `planes` is filled up to whole blocks with triangles infinitely far away, which have
/// no `exact`.
struct TriangleStore {
  static constexpr std::uint32_t block_size = 8;

  FilterFrame frame;
  std::vector<PreparedTriangle> exact;
  std::vector<TrianglePlanes> planes;
  std::vector<TriangleId> ids;  ///< by position in the mesh; empty when they are the positions

  /// The mesh's box must fit (FilterFrame::fits).
  static TriangleStore build(const TriangleMesh& mesh);

  std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(exact.size()); }
  TriangleId id(std::uint32_t place) const noexcept {
    const std::uint32_t index = exact[place].index;
    return ids.empty() ? index : ids[index];
  }
  std::size_t bytes() const noexcept;
};

}  // namespace touchmark::grid
