/// All triangles within a reach, through the hierarchy of boxes: the groups hold only what can be nearest.
#include <bit>
#include <cmath>
#include <limits>

#include "core/grid_group/direct/direct_grid.h"
#include "core/search/contacts_within.h"
#include "core/search/linear_scan.h"

namespace touchmark::grid {

std::size_t DirectGrid::contacts(const Vec3& center, double reach, DirectMemory& memory,
                                 std::span<Contact> into, Work& work) const noexcept {
  const FilterPoint point = store_.frame.point(center);
  if (!FilterFrame::covers(point)) return fallback().contacts(center, reach, into, work);
  if (rejects_at_start(center, point, reach, memory)) return 0;
  ContactsWithin found({store_.exact, bounds_, store_.ids, center, reach, into, certified_});
  if (std::isinf(found.error())) return fallback().contacts(center, reach, into, work);
  const double farthest = reach + store_.frame.kernel_error(point.plane_error);
  const float limit = store_.frame.limit(farthest * farthest);
  BoxStack stack;
  const auto visit = [&](std::uint32_t level, std::uint32_t node) {
    work.boxes += BoxTree::arity;
    stack.push(lower_bounds(tree_.node(level, node), point), limit, node, level);
  };
  visit(static_cast<std::uint32_t>(tree_.levels()) - 1, 0);
  while (!stack.empty()) {
    const BoxStack::Entry next = stack.pop();
    if (next.level > 0) {
      visit(next.level - 1, next.index);
      continue;
    }
    const std::uint32_t first = next.index * TriangleStore::block_size;
    work.triangles += TriangleStore::block_size;
    for (std::uint32_t at = first; at < first + TriangleStore::block_size; at += 4) {
      const TrianglePlanes* planes = &store_.planes[at];
      const Lanes bounds = lower_bounds(planes[0], planes[1], planes[2], planes[3], point);
      for (unsigned left = at_most(bounds, limit); left != 0; left &= left - 1)
        found.consider(at + static_cast<std::uint32_t>(std::countr_zero(left)), work);
    }
  }
  const std::size_t count = found.finish(work);
  if (count == 0) remember(center, point.plane_error, reach, std::numeric_limits<double>::infinity(), memory);
  return count;
}

}  // namespace touchmark::grid
