/// All triangles within a reach, through the hierarchy.
#include <algorithm>
#include <cmath>

#include "core/float_limits.h"
#include "core/point_queries/near_leaves.h"
#include "core/point_queries/queries.h"
#include "core/search/contacts_within.h"

namespace touchmark::queries {
namespace {

/// Shows every triangle within a limit that stays.
struct ContactsVisitor {
  ContactsWithin& found;
  const FilterFrame& frame;
  double error;  ///< bounds that of a computed distance as the filter sees it
  const Vec3& center;
  float limit;
  double farthest = infinity;
  LimitedWork work{};

  bool accepts(std::uint32_t) const noexcept { return true; }
  void update(std::uint32_t at, const Offset& offset) noexcept {
    found.consider(at, offset, work);
    if (work.exceeds_limit()) limit = -1;
    if (!(found.farthest() < farthest)) return;
    farthest = found.farthest();
    limit = std::min(limit, frame.limit((farthest + error) * (farthest + error)));
  }
};

/// Remembers the nearest triangle and its computed distance.
void remember_nearest(const Vec3& center, std::uint32_t slot, double distance, double pad,
                      PointMemory& memory) noexcept {
  memory.move = center - memory.center;
  memory.center = center;
  memory.upper = distance;
  memory.slot = slot;
  memory.lower = distance * (1 - 0x1p-40) - pad;
}

}  // namespace

std::size_t contacts(const Surface& surface, const Vec3& center, double reach, PointMemory& memory,
                     std::span<Contact> into, bool counts_all, LimitedWork& work) noexcept {
  const WideBvh& bvh = surface.bvh;
  memory.claim(bvh.epoch());
  const FilterPoint point = bvh.frame().point(center);
  const auto look_at_all = [&] {
    return must_end(bvh, work) ? 0
                               : scan_of(bvh, surface.certified, work).contacts(center, reach, into, work);
  };
  if (!bvh.can_search(point)) return look_at_all();
  const double error = bvh.frame().kernel_error(point.plane_error);
  if (!is_listed(center, center, reach + 2 * error, memory.neighborhood)) {
    const double clearance = sampled_clearance(bvh, point);
    if (clearance > reach) {
      memory.remember(center, clearance, infinity);
      return 0;
    }
  }
  ContactsWithin found(
      {bvh.parts().triangles, bvh.bounds(), bvh.ids(), center, reach, into, surface.certified, counts_all});
  if (std::isinf(found.error())) return look_at_all();
  if (!contacts_listed(bvh, center, reach, error, found, memory, work)) {
    const double farthest = reach + error;
    ContactsVisitor visitor{found, bvh.frame(), error, center, bvh.frame().limit(farthest * farthest)};
    visitor.work = work.rest();
    if (search_near(bvh, point, visitor, memory, visitor.work.limit) == bvh::exhausted)
      visitor.work.undecided = true;
    work.take(visitor.work);
  }
  const std::size_t count = found.finish(work, work.left() / LimitedWork::exact_weight);
  work.undecided = work.undecided || found.ran_out();
  if (work.undecided)
    memory.forget_distance();
  else if (found.nearest())
    remember_nearest(center, found.nearest()->slot, found.nearest()->distance, clearance_pad(bvh, point),
                     memory);
  else if (count == 0)
    memory.remember(center, reach - clearance_pad(bvh, point), infinity);
  return count;
}

}  // namespace touchmark::queries
