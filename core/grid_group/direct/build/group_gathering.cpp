// How a GroupFinder gathers what is near.
#include <algorithm>
#include <cstdint>

#include "core/grid_group/direct/build/group_finder.h"

namespace touchmark::grid {

/// Makes near_ hold every triangle that reaches into the box, or says that they are too many.
bool GroupFinder::gather(std::uint32_t slot, const FaceFrame& face_frame, const Aabb& box) noexcept {
  if (gathered_.contains(box.min) && gathered_.contains(box.max)) return true;
  if (effort_.shares && slot >= alone_until_) {
    gathered_ = shared_box(slot, face_frame, box);
    if (gather_in(gathered_)) return true;
    alone_until_ = (slot / TriangleStore::block_size + 1) * TriangleStore::block_size;
  }
  gathered_ = box;
  if (gather_in(gathered_)) return true;
  gathered_ = Aabb();
  return false;
}

/// Returns a box that probably holds those of the slots behind this one in its block, too.
Aabb GroupFinder::shared_box(std::uint32_t slot, const FaceFrame& face_frame,
                             const Aabb& box) const noexcept {
  Aabb own;
  for (const Vec3& corner : face_frame.corner) own.extend(corner);
  const Vec3 around = (own.min - box.min).cwiseMax(box.max - own.max);
  const float radius = store_.balls[slot].radius;
  const std::uint32_t end =
      std::min((slot / TriangleStore::block_size + 1) * TriangleStore::block_size, store_.size());
  Aabb shared = box;
  for (std::uint32_t other = slot + 1; other < end; ++other) {
    const float larger = store_.balls[other].radius / radius;
    if (larger > 2) continue;
    const Vec3 padding = static_cast<double>(larger) * around;
    for (const Vec3& in_mesh : store_.exact[other].corner) {
      const Vec3 corner = store_.frame.to_frame(in_mesh);
      shared.extend(corner - padding);
      shared.extend(corner + padding);
    }
  }
  return shared;
}

bool GroupFinder::gather_in(const Aabb& box) noexcept {
  const NearBalls::Most most{std::min<std::uint64_t>(max_near, effort_.max_near), effort_.max_boxes};
  const std::uint64_t seen = boxes_seen_;
  const bool are_few = near_.gather(store_, tree_, FloatBounds(box), most, boxes_seen_);
  work_.boxes += boxes_seen_ - seen;
  return are_few;
}

}  // namespace touchmark::grid
