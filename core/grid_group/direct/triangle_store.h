/// The mesh's triangles as the direct form keeps them: near in space, near in memory, eight to a block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aabb.h"
#include "core/geometry/point_triangle.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/triangle_mesh.h"

namespace touchmark::grid {

/// A ball about a point of the triangle's plane that holds the triangle, in the filter's frame: it bounds the
/// distance well beyond a corner, where the four planes do not.
struct TriangleBall {
  float x, y, z, radius;
};

/// Slots are positions in an order that halves the mesh again and again across its longest side;
/// `exact[slot].index` is the position in the mesh. `planes` and `balls` are filled up to whole blocks with
/// triangles infinitely far away, which have no `exact`.
struct TriangleStore {
  static constexpr std::uint32_t block_size = 8;

  FilterFrame frame;
  std::vector<PreparedTriangle> exact;
  std::vector<TrianglePlanes> planes;
  std::vector<TriangleBall> balls;
  bool fourth_powers_fit = false;  ///< do fourth powers of the mesh's extent fit the range of double?
  TriangleIds ids;

  /// The mesh's box must fit (FilterFrame::fits).
  static TriangleStore build(const TriangleMesh& mesh, unsigned threads = 1);
  /// The mesh's same triangles where they are now, in the frame as it is; slots stay. Returns boxes, in the
  /// frame, each of which holds some triangles that moved, as they were and as they are.
  std::vector<Aabb> move(const TriangleMesh& mesh);

  std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(exact.size()); }
  TriangleId id(std::uint32_t slot) const noexcept { return ids[exact[slot].index]; }
  std::size_t bytes() const noexcept;
};

}  // namespace touchmark::grid
