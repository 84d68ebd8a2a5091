/// The first triangle that a moving ball touches.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/bvh/traversal.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/geometry/sweep_box.h"
#include "core/point_queries/near_leaves.h"
#include "core/point_queries/queries.h"
#include "core/point_queries/sweep_candidates.h"
#include "core/search/first_touch.h"
#include "core/search/tracing.h"

namespace touchmark::queries {
namespace {

/// Keeps the first hit among the triangles near the middle of a path.
struct MiddleVisitor {
  Vec3 center;
  float limit;
  SweepCandidates& candidates;
  LimitedWork work{};

  bool accepts(std::uint32_t at) const noexcept { return !candidates.passes_over(at); }
  void update(std::uint32_t at, const Offset& offset) noexcept {
    candidates.consider(at, center, offset, work);
  }
};

/// Keeps the first hit; what is left of the path falls with it.
struct SweepVisitor {
  double length;  ///< the path's in the tree's frame, rounded up
  float error;
  SweepCandidates& candidates;
  LimitedWork work{};

  float until() const noexcept { return static_cast<float>(candidates.limit() * length) + error; }
  void consider(std::uint32_t at) noexcept { candidates.take(at, work); }
};

/// A ball about the middle of a longer path meets more than the path does: more in its length, and in the
/// radius about as much as their product. So it does where it is that much wider than the ball on the path.
constexpr double max_in_leaf_radii = 0.5, max_product_in_leaf_radii = 0.25, max_in_reaches = 8;
/// More work than this about the middle shows that leaves are long and near to one another, so that their
/// radius misleads: the path is looked along instead.
constexpr std::uint64_t middle_budget = 1024;

/// True if the last contacts were asked for at this place. A proxy stands there, off the surface as a rule,
/// and the search of the path decides what the ball touches at its start.
bool stands_as_proxy(const Vec3& at, const PointMemory& memory) noexcept {
  return memory.neighborhood.contacts_reach >= 0 && memory.neighborhood.measured_at == at;
}

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

/// In plane_errors of both ends together: the sum of all rounding is below 5 of them.
constexpr float path_error = 8;

/// What may be in the way is taken to be, at the start.
std::optional<Impact> undecided() noexcept { return Impact(); }

/// Remembers where the ball is free at the end, or returns what it meets.
std::optional<Impact> conclude(const Surface& surface, const FirstTouch& first, PointMemory& memory,
                               LimitedWork& work) noexcept {
  if (work.undecided) return undecided();
  const Sweep& sweep = first.sweep();
  if (surface.certified && !first.found()) {
    memory.free_center = sweep.to;
    memory.free_radius = sweep.radius;
    return std::nullopt;
  }
  const std::optional<Impact> impact = impact_of(
      first, surface.bvh.ids(), surface.certified, [&](double reach_at_start) -> std::optional<Contact> {
        if (work.limit == LimitedWork::unlimited)
          return nearest(surface, sweep.from, reach_at_start, memory, work);
        const WithinBudget start = nearest_within_budget(surface, sweep.from, reach_at_start, memory, work);
        if (start.exhausted) work.undecided = true;
        return start.contact;
      });
  return work.undecided ? undecided() : impact;
}

/// True if all of the path is in balls that are clear of the mesh: that about its start, that about its end,
/// and up to two in between, each about the place where the ones before it end. Then the end is remembered.
bool is_sampled_clear(const WideBvh& bvh, const Sweep& sweep, double length, double reach,
                      PointMemory& memory) noexcept {
  constexpr int max_between = 2;
  const double clear_of = reach + position_error(sweep), way = length * (1 + 0x1p-40);
  const double at_end = sampled_clearance(bvh, bvh.frame().point(sweep.to));
  double covered = memory.lower - (sweep.from - memory.center).norm() * (1 + 0x1p-40) - clear_of;
  for (int between = 0; at_end > clear_of; ++between) {
    if (!(covered > 0)) return false;
    if (covered + (at_end - clear_of) > way) {
      memory.center = sweep.to;
      memory.lower = at_end;
      memory.upper = std::numeric_limits<double>::infinity();
      return true;
    }
    if (between == max_between) return false;
    const double more =
        sampled_clearance(bvh, bvh.frame().point(position_at(sweep, covered / way))) - clear_of;
    if (!(more > 0)) return false;
    covered += more;
  }
  return false;
}

/// Looks in a ball about the middle, which is rounded to a point. Returns false when the work budget was
/// exhausted.
bool search_middle(const WideBvh& bvh, const Sweep& sweep, double length, double reach, std::uint64_t budget,
                   SweepCandidates& candidates, const PointMemory& memory, LimitedWork& work) noexcept {
  const double ball = reach + position_error(sweep) + 0.5 * length * (1 + 0x1p-40);
  MiddleVisitor visitor{position_at(sweep, 0.5), bvh.frame().limit(ball * ball), candidates};
  visitor.work = work.rest();
  const bool done =
      search_listed(bvh, bvh.frame().point(visitor.center), visitor, memory, budget) != bvh::exhausted;
  work.take(visitor.work);
  return done;
}

/// Looks along the path. Returns false when the work budget was exhausted.
bool search_path(const WideBvh& bvh, const Sweep& sweep, double length, double reach, std::uint64_t budget,
                 SweepCandidates& candidates, LimitedWork& work) noexcept {
  const Vec3 direction = (sweep.to - sweep.from) / length;
  const FilterPoint from = bvh.frame().point(sweep.from), to = bvh.frame().point(sweep.to);
  const float error = path_error * (from.plane_error + to.plane_error);
  const bvh::Path path{from,
                       static_cast<float>(direction.x()),
                       static_cast<float>(direction.y()),
                       static_cast<float>(direction.z()),
                       std::sqrt(bvh.frame().limit(reach * reach)) * (1 + 0x1p-20F) + error,
                       error};
  SweepVisitor visitor{length * bvh.frame().scale() * (1 + 0x1p-20), error, candidates};
  visitor.work = work.rest();
  const bool done =
      bvh::with_isa(bvh.simd(), [&](auto isa) { return isa.sweep(bvh.parts(), path, budget, visitor); });
  candidates.consider_waiting(visitor.work);
  work.take(visitor.work);
  return done;
}

}  // namespace

std::optional<Impact> first_hit(const Surface& surface, const Sweep& sweep, PointMemory& memory,
                                LimitedWork& work) noexcept {
  const WideBvh& bvh = surface.bvh;
  const auto look_at_all = [&]() -> std::optional<Impact> {
    if (must_end(bvh, work)) return undecided();
    return scan_of(bvh, surface.certified, work).first_hit(sweep, work);
  };
  if (!bvh.can_search(sweep.from) || !bvh.can_search(sweep.to)) return look_at_all();
  memory.claim(bvh.epoch());
  if constexpr (tracing)
    if (visits != nullptr) visits->frame = &bvh.frame();
  const std::uint64_t before = work.total();
  const double reach = padded_sweep_radius(sweep, largest_difference(bvh.bounds(), sweep));
  FirstTouch first(sweep);
  if (surface.certified &&
      sweep_listed(bvh, sweep, reach, std::min(max_work(bvh) / 2, work.left()), first, memory, work))
    return conclude(surface, first, memory, work);
  if (!memory.knows_free(sweep.from, sweep.radius) && !is_clear(bvh, sweep.from, sweep.radius, memory) &&
      !(surface.certified && stands_as_proxy(sweep.from, memory))) {
    const WithinBudget start = nearest_within_budget(surface, sweep.from, sweep.radius, memory, work);
    if (start.exhausted) return look_at_all();
    if (start.contact) return Impact{0, *start.contact};
  }
  if (is_clear(bvh, sweep, memory)) return std::nullopt;
  const double length = (sweep.to - sweep.from).norm();
  if (is_sampled_clear(bvh, sweep, length, reach, memory)) return std::nullopt;
  const auto budget = [&] { return std::min(remaining(max_work(bvh), work.total() - before), work.left()); };
  SweepCandidates candidates(bvh, sweep.radius > bvh.mean_leaf_radius(),
                             memory.is_near() ? memory.slot : nowhere, first);
  const bool is_short =
      length <= max_in_reaches * reach && length <= max_in_leaf_radii * bvh.mean_leaf_radius() &&
      length * reach <= max_product_in_leaf_radii * bvh.mean_leaf_radius() * bvh.mean_leaf_radius();
  const bool done = (is_short && search_middle(bvh, sweep, length, reach, std::min(budget(), middle_budget),
                                               candidates, memory, work)) ||
                    search_path(bvh, sweep, length, reach, budget(), candidates, work);
  if (!done && !work.undecided && !must_end(bvh, work)) {
    bvh::build_rest(bvh.parts(), work);
    work.triangles += bvh.parts().triangles.size();
    for (std::uint32_t at = 0; at < bvh.parts().triangles.size() && !work.undecided; ++at)
      candidates.consider(at, work);
  }
  return conclude(surface, first, memory, work);
}

}  // namespace touchmark::queries
