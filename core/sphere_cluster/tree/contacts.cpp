/// All triangles within a reach, through the hierarchy.
#include <algorithm>
#include <cmath>

#include "core/float_limits.h"
#include "core/search/contacts_within.h"
#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/search.h"  // IWYU pragma: keep

namespace touchmark {
namespace {

/// Shows every triangle within a limit that stays.
struct ContactsVisitor {
  ContactsWithin& found;
  const FilterFrame& frame;
  double error;  ///< bounds that of a computed distance as the filter sees it
  const Vec3& center;
  float limit;
  double farthest = infinity;
  Work work{};

  bool accepts(std::uint32_t) const noexcept { return true; }
  void update(std::uint32_t at, const Offset& offset) noexcept {
    found.consider(at, offset, work);
    if (!(found.farthest() < farthest)) return;
    farthest = found.farthest();
    limit = std::min(limit, frame.limit((farthest + error) * (farthest + error)));
  }
};

}  // namespace

std::size_t SphereTree::contacts(const Vec3& center, double reach, Memory& memory, std::span<Contact> into,
                                 bool counts_all, Work& work) const noexcept {
  claim(memory);
  const FilterPoint point = frame_.point(center);
  if (!can_search(point)) return fallback(work).contacts(center, reach, into, work);
  const double error = frame_.kernel_error(point.plane_error);
  if (!is_listed(center, center, reach + 2 * error, memory.neighborhood)) {
    const double clearance = sampled_clearance(point);
    if (clearance > reach) {
      remember_touch(center, clearance, infinity, memory);
      return 0;
    }
  }
  ContactsWithin found({parts_.triangles, bounds_, ids_, center, reach, into, certified_, counts_all});
  if (std::isinf(found.error())) return fallback(work).contacts(center, reach, into, work);
  if (!contacts_listed(center, reach, error, found, memory, work)) {
    const double farthest = reach + error;
    ContactsVisitor visitor{found, frame_, error, center, frame_.limit(farthest * farthest)};
    search_near(point, visitor, memory, any_work);
    work += visitor.work;
  }
  const std::size_t count = found.finish(work);
  if (found.nearest())
    remember_nearest(center, found.nearest()->slot, found.nearest()->distance, clearance_pad(point), memory);
  else if (count == 0)
    remember_touch(center, reach - clearance_pad(point), infinity, memory);
  return count;
}

/// Remembers the nearest triangle and its computed distance.
void SphereTree::remember_nearest(const Vec3& center, std::uint32_t slot, double distance, double pad,
                                  Memory& memory) noexcept {
  memory.move = center - memory.center;
  memory.center = center;
  memory.upper = distance;
  memory.slot = slot;
  memory.lower = distance * (1 - 0x1p-40) - pad;
}

}  // namespace touchmark
