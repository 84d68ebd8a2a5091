#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/search/around.h"
#include "core/search/tracing.h"
#include "core/sphere_cluster/queries/near_leaves.h"
#include "core/sphere_cluster/queries/nearest_visitor.h"
#include "core/sphere_cluster/queries/queries.h"
#include "core/sphere_cluster/queries/sampled.h"

namespace touchmark::spheres {
namespace {

/// Searches in the order of docs/algorithms/sphere-cluster.md, "nearest". Returns what one of the functions
/// of `ends` returns: nothing(); found(visitor, error, distance); exhausted() where the work budget is used
/// up; without() where the hierarchy cannot be searched. Always inline, so that no contact is copied.
template <class Ends>
[[gnu::always_inline]] inline auto search_nearest(const WideBvh& bvh, const Vec3& center, double reach,
                                                  PointMemory& memory, Work& work, std::uint64_t budget,
                                                  const Ends& ends) noexcept {
  memory.claim(bvh.epoch());
  if constexpr (tracing)
    if (visits != nullptr) visits->frame = &bvh.frame();
  const FilterPoint point = bvh.frame().point(center);
  if (!bvh.can_search(point)) return ends.without();
  bool near = false;
  if (memory.is_near()) {
    const double moved = (center - memory.center).norm();
    near = moved <= max_move_in_leaf_radii * bvh.mean_leaf_radius() && memory.upper + moved <= reach;
  }
  if (!near && (rejects_by_distance_field(bvh, point, center, reach, memory) ||
                (bvh.is_lazy() && rejects_once_sampled(bvh, point, center, reach, memory, budget, work))))
    return ends.nothing();
  const double error = bvh.frame().kernel_error(point.plane_error);
  NearestVisitor visitor(bvh.parts(), bvh.frame(), center,
                         bvh.frame().limit((reach + error) * (reach + error)), error);
  visitor.names_all = Ends::names_all;
  float unseen = 0;
  if (near) {
    bvh::visit(bvh, memory.slot, visitor);
    unseen = search_near(bvh, point, visitor, memory, budget);
  } else {
    const double farthest = sampled_distance(bvh, point);
    if (farthest < reach) visitor.limit = bvh.frame().limit((farthest + error) * (farthest + error));
    unseen = bvh::traverse(bvh, point, visitor, budget);
  }
  if (unseen == bvh::exhausted) {
    work += visitor.work;
    memory.forget_distance();
    return ends.exhausted();
  }
  const ClosestCandidates& candidates = visitor.candidates;
  const double distance = std::sqrt(candidates.best().squared_distance);
  memory.move = center - memory.center;
  memory.center = center;
  memory.upper = distance;
  memory.lower = clearance_from(bvh, unseen, distance, clearance_pad(bvh, point));
  work += visitor.work;
  if (!candidates.found()) return ends.nothing();
  memory.slot = candidates.at();
  return ends.found(visitor, error, distance);
}

/// A search that ends with a contact.
template <class Exhausted>
struct ContactEnds {
  const Surface& surface;
  const Vec3& center;
  double reach;
  Work& work;
  const Exhausted& exhausted;

  static constexpr bool names_all = false;
  static std::optional<Contact> nothing() noexcept { return std::nullopt; }
  std::optional<Contact> without() const noexcept {
    return nearest_of_every(surface.bvh, center, reach, work);
  }
  [[gnu::always_inline]] std::optional<Contact> found(const NearestVisitor& visitor, double error,
                                                      double distance) const noexcept {
    return contact_found(surface, visitor, reach, error, distance, work);
  }
};

/// A search that ends with the triangles that may be nearest.
struct CloseEnds {
  const WideBvh& bvh;
  double reach, slack;
  CloseTriangles& into;

  static constexpr bool names_all = true;
  bool nothing() const noexcept {
    into.count = 0;
    return true;
  }
  static bool without() noexcept { return false; }
  static bool exhausted() noexcept { return false; }
  bool found(const NearestVisitor& visitor, double error, double distance) const noexcept {
    into.count = 0;
    if (distance > reach + error) return true;
    // The search was shown what is farther by at most the error, as computed: half of it is rounding's.
    if (!(2 * slack <= error)) return false;
    into.least = distance;
    into.error = error;
    bool fits = true;
    const auto add = [&](std::uint32_t at) {
      fits = fits && into.count < into.triangle.size();
      if (fits) into.triangle[into.count++] = bvh.parts().triangles[at].index;
    };
    return visitor.candidates.visit_close(add) && fits;
  }
};

}  // namespace

std::optional<Contact> nearest(const Surface& surface, const Vec3& center, double reach, PointMemory& memory,
                               Work& work) noexcept {
  const auto exhausted = [&] {
    return scan_of(surface.bvh, surface.certified, work).nearest(center, reach, work);
  };
  return search_nearest(surface.bvh, center, reach, memory, work, max_nearest_work(surface.bvh),
                        ContactEnds<decltype(exhausted)>{surface, center, reach, work, exhausted});
}

bool close_triangles(const Surface& surface, const Vec3& center, double reach, double slack,
                     PointMemory& memory, CloseTriangles& into, Work& work) noexcept {
  return search_nearest(surface.bvh, center, reach, memory, work, max_nearest_work(surface.bvh),
                        CloseEnds{surface.bvh, reach, slack, into});
}

WithinBudget nearest_within_budget(const Surface& surface, const Vec3& center, double reach,
                                   PointMemory& memory, Work& work) noexcept {
  bool is_exhausted = false;
  const auto exhausted = [&]() -> std::optional<Contact> {
    is_exhausted = true;
    return std::nullopt;
  };
  std::optional<Contact> contact =
      search_nearest(surface.bvh, center, reach, memory, work, max_work(surface.bvh),
                     ContactEnds<decltype(exhausted)>{surface, center, reach, work, exhausted});
  return {std::move(contact), is_exhausted};
}

}  // namespace touchmark::spheres
