/// A hierarchy with groups and cells beside it: what a query for the nearest need not descend for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/grid_group/direct/cells.h"
#include "core/grid_group/direct/groups.h"
#include "core/point_queries/surface.h"
#include "core/search/tracing.h"

namespace touchmark::grid {

/// See core/point_queries/nearest_search.h.
struct GroupedSurface : queries::Surface {
  Groups groups;
  Cells cells;

  std::uint32_t guess(const Vec3& center) const noexcept {
    if constexpr (tracing) note_cell(center);
    return cells.at(center);
  }
  std::span<const bvh::ChildRef> all_near(std::uint32_t slot, const FilterPoint& point) const noexcept {
    if (groups.empty()) return {};
    const Group& group = groups.of(slot);
    const bvh::TriangleBlock& block = bvh.parts().blocks[slot / bvh::width];
    const bool covers = group.count() > 0 &&
                        group.covers(plane_values(block.planes(slot % bvh::width), point), point.plane_error);
    if constexpr (tracing) note_group(group, covers);
    return covers ? groups.blocks(group) : std::span<const bvh::ChildRef>();
  }
  std::size_t bytes() const noexcept { return bvh.bytes() + groups.bytes() + cells.bytes(); }
  void note_group(const Group& group, bool covers) const;
  void note_cell(const Vec3& center) const;
};

}  // namespace touchmark::grid
