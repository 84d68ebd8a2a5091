#include "core/grid_group/direct/grouped_surface.h"

namespace touchmark::grid {

#if TOUCHMARK_TRACING
void GroupedSurface::note_group(const Group& group, bool covers) const {
  if (visits == nullptr || group.count() == 0) return;
  Aabb box;
  std::uint32_t members = 0;
  for (const bvh::ChildRef block : groups.blocks(group)) {
    for (std::uint32_t k = 0; k < bvh::width; ++k) {
      const std::uint32_t slot = block.index() * bvh::width + k;
      if (slot >= bvh.parts().triangles.size()) break;
      for (const Vec3& corner : bvh.parts().triangles[slot].corner) box.extend(corner);
      ++members;
    }
  }
  visits->groups.push_back({box, members, covers});
}

void GroupedSurface::note_cell(const Vec3& center) const {
  const Aabb box = cells.box_of(center);
  if (visits != nullptr && !box.empty()) visits->cells.push_back(box);
}
#endif

}  // namespace touchmark::grid
