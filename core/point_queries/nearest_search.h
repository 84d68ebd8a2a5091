/// The search for the nearest triangle, for every kind of surface. One may know more than the hierarchy does
/// of where it is:
///   guess(center)   a slot whose triangle is probably near; nowhere where it knows none
///   all_near(slot, point)   the blocks that hold all that can be nearest to the point, as is known of places
///                           near the triangle in that slot; none where it is not known
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "core/point_queries/listed_search.h"
#include "core/point_queries/near_leaves.h"
#include "core/point_queries/nearest_visitor.h"
#include "core/point_queries/queries.h"
#include "core/point_queries/sampled.h"
#include "core/search/tracing.h"

// Unnamed, though in a header, since the visitor is.
namespace touchmark::queries {
namespace {

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

/// Shows the visitor all that can be nearest if the surface knows that of places near the triangle in a slot.
/// Then `unseen` is what traverse returns. Returns false where it is not known.
template <class Kind>
[[gnu::always_inline]] inline bool search_from(const Kind& surface, std::uint32_t slot,
                                               const FilterPoint& point, NearestVisitor& visitor,
                                               float& unseen) noexcept {
  if constexpr (requires { surface.all_near(slot, point); }) {
    ++visitor.work.cells;
    const std::span<const bvh::ChildRef> blocks = surface.all_near(slot, point);
    if (blocks.empty()) return false;
    unseen = bvh::with_isa(surface.bvh.simd(), [&](auto isa) {
      return isa.search_blocks(surface.bvh.parts(), point, blocks, visitor);
    });
    return true;
  }
  return false;
}

/// Searches in the order of docs/algorithms/sphere-cluster.md, "nearest". Returns what one of the functions
/// of `ends` returns: nothing(); found(visitor, error, distance); exhausted() where the work budget is used
/// up; without() where the hierarchy cannot be searched. Always inline, so that no contact is copied.
template <class Kind, class Ends>
[[gnu::always_inline]] inline auto search_nearest(const Kind& surface, const Vec3& center, double reach,
                                                  PointMemory& memory, Work& work, std::uint64_t budget,
                                                  const Ends& ends) noexcept {
  const WideBvh& bvh = surface.bvh;
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
    if (!search_from(surface, memory.slot, point, visitor, unseen))
      unseen = search_near(bvh, point, visitor, memory, budget);
  } else {
    const double farthest = sampled_distance(bvh, point);
    if (farthest < reach) visitor.limit = bvh.frame().limit((farthest + error) * (farthest + error));
    std::uint32_t guess = nowhere;
    if constexpr (requires { surface.guess(center); }) guess = surface.guess(center);
    if (guess == nowhere || !search_from(surface, guess, point, visitor, unseen))
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

/// Keeps a copy of the nearest of those listed.
void keep_nearest(const WideBvh& bvh, PointMemory& memory) noexcept {
  const bvh::FollowedPoint& around = memory.around;
  memory.is_kept = true;
  memory.triangle = bvh.parts().triangles[around.list.slot[around.nearest]];
  memory.id = bvh.ids()[memory.triangle.index];
}

/// True of a point that moves so slowly that a list is going to answer many ticks.
bool is_slow(const WideBvh& bvh, const Vec3& move) noexcept {
  const double max_move = 0.015 * bvh.mean_leaf_radius();
  return move.squaredNorm() <= max_move * max_move;
}

/// Lists the triangles around a slow point for the next ticks, if the last list answered many. `farthest`
/// bounds the distance. Returns false where there is no list.
[[gnu::noinline]] bool list_for_next(const WideBvh& bvh, const Vec3& center, double farthest,
                                     PointMemory& memory, std::uint64_t budget, Work& work) noexcept {
  constexpr std::uint32_t answers_that_pay = 8;
  bvh::FollowedPoint& around = memory.around;
  if (around.backoff.waits()) return false;
  const bool paid = around.epoch != bvh.epoch() || around.answered >= answers_that_pay;
  around.answered = answers_that_pay;
  Work spent;
  const bool is_listed = paid && list_anew(bvh, center, farthest, around, budget, spent);
  work += spent;
  if (!is_listed) {
    around.backoff.failed();
    return false;
  }
  around.backoff.paid();
  around.answered = 0;
  return true;
}

/// Lists what is around the triangle that a search for a slow point has found, and keeps it.
[[gnu::noinline]] void keep_found(const WideBvh& bvh, double farthest, PointMemory& memory,
                                  std::uint64_t budget, Work& work) noexcept {
  bvh::FollowedPoint& around = memory.around;
  if (!list_for_next(bvh, memory.center, farthest, memory, budget, work)) return;
  const std::uint32_t* const first = around.list.slot;
  const std::uint32_t* const place = std::find(first, first + around.list.count, memory.slot);
  around.nearest = static_cast<std::uint32_t>(place - first);
  if (around.nearest < around.list.count) keep_nearest(bvh, memory);
}

/// A search that ends with a contact.
template <class Kind, class Exhausted>
struct ContactEnds {
  const Kind& surface;
  const Vec3& center;
  double reach;
  PointMemory& memory;
  Work& work;
  std::uint64_t budget;
  Exhausted when_exhausted;

  static constexpr bool names_all = false;
  static std::optional<Contact> nothing() noexcept { return std::nullopt; }
  // Always inline, as all that reads a member, so that none is stored.
  [[gnu::always_inline]] std::optional<Contact> without() const noexcept {
    return nearest_of_every(surface.bvh, center, reach, work);
  }
  [[gnu::always_inline]] std::optional<Contact> exhausted() const noexcept {
    return when_exhausted(surface, center, reach, work);
  }
  [[gnu::always_inline]] std::optional<Contact> found(const NearestVisitor& visitor, double error,
                                                      double distance) const noexcept {
    if (is_slow(surface.bvh, memory.move))
      keep_found(surface.bvh, distance + error, memory, remaining(budget, visitor.work.total()), work);
    return contact_found(surface, visitor, reach, error, distance, work);
  }
};

/// Searches in the order of docs/algorithms/sphere-cluster.md, from the step of the samples on.
template <class Kind, class Exhausted>
[[gnu::always_inline]] inline std::optional<Contact> nearest_searched(const Kind& surface, const Vec3& center,
                                                                      double reach, PointMemory& memory,
                                                                      Work& work, std::uint64_t budget,
                                                                      const Exhausted exhausted) noexcept {
  return search_nearest(
      surface, center, reach, memory, work, budget,
      ContactEnds<Kind, Exhausted>{surface, center, reach, memory, work, budget, exhausted});
}

/// Looks at those listed, and lists them anew where they are not all that can be nearest. Returns false where
/// that does not tell.
bool search_around(const WideBvh& bvh, double reach, double error, NearestVisitor& visitor,
                   PointMemory& memory, std::uint64_t budget) noexcept {
  bvh::FollowedPoint& around = memory.around;
  if (search_listed(bvh, reach, error, around, visitor)) return true;
  if (!visitor.candidates.found()) return false;
  const double farthest = std::sqrt(visitor.candidates.best().squared_distance) + error;
  const Vec3& center = visitor.center;
  return is_slow(bvh, center - memory.center) &&
         list_for_next(bvh, center, farthest, memory, budget, visitor.work) &&
         search_listed(bvh, reach, error, around, visitor);
}

/// Looks at those listed around the point, else searches. `exhausted(surface, center, reach, work)` answers
/// where that takes more than the budget.
template <class Kind, class Exhausted>
[[gnu::noinline]] std::optional<Contact> nearest_around(const Kind& surface, const Vec3& center, double reach,
                                                        PointMemory& memory, Work& work, std::uint64_t budget,
                                                        const Exhausted exhausted) noexcept {
  const WideBvh& bvh = surface.bvh;
  const FilterPoint point = bvh.frame().point(center);
  const double error = bvh.frame().kernel_error(point.plane_error);
  NearestVisitor visitor(bvh.parts(), bvh.frame(), center,
                         bvh.frame().limit((reach + error) * (reach + error)), error);
  const bool is_told = bvh.can_search(point) && search_around(bvh, reach, error, visitor, memory, budget);
  work += visitor.work;
  if (!is_told) {
    memory.is_kept = false;
    const std::uint64_t left = remaining(budget, visitor.work.total());
    return nearest_searched(surface, center, reach, memory, work, left, exhausted);
  }
  ++memory.around.answered;
  keep_nearest(bvh, memory);
  memory.move = center - memory.center;
  memory.center = center;
  memory.upper = std::sqrt(visitor.candidates.best().squared_distance);
  memory.lower = std::min(memory.upper, reach) * (1 - 0x1p-40) - clearance_pad(bvh, point);
  if (!visitor.candidates.found()) return std::nullopt;
  memory.slot = visitor.candidates.at();
  return contact_found(surface, visitor, reach, error, memory.upper, work);
}

/// Answers from what is kept, else looks around, else searches.
template <class Kind, class Exhausted>
[[gnu::always_inline]] inline std::optional<Contact> nearest_of(const Kind& surface, const Vec3& center,
                                                                double reach, PointMemory& memory, Work& work,
                                                                std::uint64_t budget,
                                                                const Exhausted exhausted) noexcept {
  const WideBvh& bvh = surface.bvh;
  if (!memory.is_kept || memory.epoch != bvh.epoch())
    return nearest_searched(surface, center, reach, memory, work, budget, exhausted);
  prefetch_lines(&memory, sizeof(bvh::KeptNearest));
  // By value: where nothing is kept, nothing of this is stored.
  const auto look_around = [&surface, &center, reach, &memory, &work, budget, exhausted] {
    return nearest_around(surface, center, reach, memory, work, budget, exhausted);
  };
  return bvh::with_isa(bvh.simd(), [&](auto isa) {
    return isa.nearest_kept(bvh.frame(), bvh.parts().triangles.data(), center, reach, memory, work,
                            look_around);
  });
}

/// Answers `nearest` over any kind of surface.
template <class Kind>
[[gnu::always_inline]] inline std::optional<Contact> nearest_over(const Kind& surface, const Vec3& center,
                                                                  double reach, PointMemory& memory,
                                                                  Work& work) noexcept {
  const auto exhausted = [](const Kind& all, const Vec3& at, double as_far, Work& spent) {
    return scan_of(all.bvh, all.certified, spent).nearest(at, as_far, spent);
  };
  return nearest_of(surface, center, reach, memory, work, max_nearest_work(surface.bvh), exhausted);
}

}  // namespace
}  // namespace touchmark::queries
