#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/geometry/distance_error.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/geometry/sweep_box.h"
#include "core/search/first_touch.h"
#include "core/search/tracing.h"
#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/search.h"  // IWYU pragma: keep
#include "core/sphere_cluster/tree/sweep_candidates.h"

namespace touchmark {
namespace {

/// Keeps the first hit among the triangles near the middle of a path.
struct MiddleVisitor {
  Vec3 center;
  float limit;
  spheres::SweepCandidates& candidates;
  Work work{};

  bool accepts(std::uint32_t at) const noexcept { return !candidates.passes_over(at); }
  void update(std::uint32_t at, const Offset& offset) noexcept {
    candidates.consider(at, center, offset, work);
  }
};

/// Keeps the first hit; what is left of the path falls with it.
struct SweepVisitor {
  double length;  ///< the path's in the tree's frame, rounded up
  float error;
  spheres::SweepCandidates& candidates;
  Work work{};

  float until() const noexcept { return static_cast<float>(candidates.limit() * length) + error; }
  void consider(std::uint32_t at) noexcept { candidates.take(at, work); }
};

/// A ball about the middle of a longer path meets more than the path does: more in its length, and in the
/// radius about as much as their product.
constexpr double longest_in_leaf_radii = 0.5, largest_product_in_leaf_radii = 0.25;
/// More work than this about the middle shows that leaves are long and near to one another, so that their
/// radius misleads: the path is looked along instead.
constexpr std::uint64_t middle_budget = 1024;

/// Were contacts asked for last there? Then that is where a proxy stands, off the surface as a rule, and what
/// the ball touches at the start is left to the search.
bool stands_as_proxy(const Vec3& at, const SphereTree::Memory& memory) noexcept {
  return memory.neighborhood.contacts_reach >= 0 && memory.neighborhood.measured_at == at;
}

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

/// In plane_errors of both ends together: the sum of all rounding is below 5 of them.
constexpr float path_error = 8;

}  // namespace

std::optional<Impact> SphereTree::first_hit(const Sweep& sweep, Memory& memory, Work& work) const noexcept {
  if (!can_search(sweep.from) || !can_search(sweep.to)) return fallback(work).first_hit(sweep, work);
  claim(memory);
  if constexpr (tracing)
    if (visits != nullptr) visits->frame = &frame_;
  const std::uint64_t before = work.total();
  const double reach = padded_sweep_radius(sweep, largest_difference(bounds_, sweep));
  FirstTouch first(sweep);
  if (sweep_listed(sweep, reach, work_limit() / 2, first, memory, work)) return conclude(first, memory, work);
  if (!memory.knows_free(sweep.from, sweep.radius) && !is_clear(sweep.from, sweep.radius, memory) &&
      !(certified_ && stands_as_proxy(sweep.from, memory))) {
    const WithinBudget start = nearest_within_budget(sweep.from, sweep.radius, memory, work);
    if (start.exhausted) return fallback(work).first_hit(sweep, work);
    if (start.contact) return Impact{0, *start.contact};
  }
  if (is_clear(sweep, memory)) return std::nullopt;
  const double length = (sweep.to - sweep.from).norm();
  if (is_sampled_clear(sweep, length, reach, memory)) return std::nullopt;
  const std::uint64_t budget = remaining(work_limit(), work.total() - before);
  spheres::SweepCandidates candidates(parts_, frame_.scale(), sweep.radius > mean_leaf_radius_, simd_,
                                      memory.is_near() ? memory.slot : nowhere, first);
  const bool is_short =
      length <= longest_in_leaf_radii * mean_leaf_radius_ &&
      length * reach <= largest_product_in_leaf_radii * mean_leaf_radius_ * mean_leaf_radius_;
  const bool done =
      (is_short &&
       search_middle(sweep, length, reach, std::min(budget, middle_budget), candidates, memory, work)) ||
      search_path(sweep, length, reach, remaining(work_limit(), work.total() - before), candidates, work);
  if (!done) {
    spheres::build_rest(parts_, work);
    work.triangles += parts_.triangles.size();
    for (std::uint32_t at = 0; at < parts_.triangles.size(); ++at) candidates.consider(at, work);
  }
  return conclude(first, memory, work);
}

/// Remembers where the ball is free at the end, or returns what it meets.
std::optional<Impact> SphereTree::conclude(const FirstTouch& first, Memory& memory,
                                           Work& work) const noexcept {
  const Sweep& sweep = first.sweep();
  if (certified_ && !first.found()) {
    memory.free_center = sweep.to;
    memory.free_radius = sweep.radius;
    return std::nullopt;
  }
  return impact_of(first, parts_.triangles, ids_, certified_,
                   [&](double reach_at_start) { return nearest(sweep.from, reach_at_start, memory, work); });
}

/// Is all of the path in balls that are clear of the mesh: that about its start, that about its end, and up
/// to two in between, each about the place where the ones before it end? Then the end is remembered.
bool SphereTree::is_sampled_clear(const Sweep& sweep, double length, double reach,
                                  Memory& memory) const noexcept {
  constexpr int most_between = 2;
  const double clear_of = reach + position_error(sweep), way = length * (1 + 0x1p-40);
  const double at_end = sampled_clearance(frame_.point(sweep.to));
  double covered = memory.lower - (sweep.from - memory.center).norm() * (1 + 0x1p-40) - clear_of;
  for (int between = 0; at_end > clear_of; ++between) {
    if (!(covered > 0)) return false;
    if (covered + (at_end - clear_of) > way) {
      memory.center = sweep.to;
      memory.lower = at_end;
      memory.upper = std::numeric_limits<double>::infinity();
      return true;
    }
    if (between == most_between) return false;
    const double more = sampled_clearance(frame_.point(position_at(sweep, covered / way))) - clear_of;
    if (!(more > 0)) return false;
    covered += more;
  }
  return false;
}

/// Looks in a ball about the middle, which is rounded to a point. Returns false when the work budget was
/// exhausted.
bool SphereTree::search_middle(const Sweep& sweep, double length, double reach, std::uint64_t budget,
                               spheres::SweepCandidates& candidates, const Memory& memory,
                               Work& work) const noexcept {
  const double ball = reach + position_error(sweep) + 0.5 * length * (1 + 0x1p-40);
  MiddleVisitor visitor{position_at(sweep, 0.5), frame_.limit(ball * ball), candidates};
  const bool done =
      search_listed(frame_.point(visitor.center), visitor, memory, budget) != spheres::exhausted;
  work += visitor.work;
  return done;
}

/// Looks along the path. Returns false when the work budget was exhausted.
bool SphereTree::search_path(const Sweep& sweep, double length, double reach, std::uint64_t budget,
                             spheres::SweepCandidates& candidates, Work& work) const noexcept {
  const Vec3 direction = (sweep.to - sweep.from) / length;
  const FilterPoint from = frame_.point(sweep.from), to = frame_.point(sweep.to);
  const float error = path_error * (from.plane_error + to.plane_error);
  const spheres::Path path{from,
                           static_cast<float>(direction.x()),
                           static_cast<float>(direction.y()),
                           static_cast<float>(direction.z()),
                           std::sqrt(frame_.limit(reach * reach)) * (1 + 0x1p-20F) + error,
                           error};
  SweepVisitor visitor{length * frame_.scale() * (1 + 0x1p-20), error, candidates};
  const bool done = simd_ == Simd::portable ? spheres::portable::sweep(parts_, path, budget, visitor)
                                            : spheres::avx2::sweep(parts_, path, budget, visitor);
  candidates.consider_waiting(visitor.work);
  work += visitor.work;
  return done;
}

}  // namespace touchmark
