#include <algorithm>
#include <cmath>

#include "core/geometry/distance_error.h"
#include "core/geometry/sweep_box.h"
#include "core/search/first_touch.h"
#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/search.h"  // IWYU pragma: keep

namespace touchmark {
namespace {

/// Keeps the first hit of the whole sweep among the triangles near a part of it.
struct SweepVisitor {
  const spheres::TreeParts& tree;
  const Sweep& sweep;
  Vec3 center;
  float limit;
  Work work{};
  FirstTouch first{sweep};

  /// Never: how far the triangle is from the centre does not matter.
  bool accepts(std::uint32_t at) noexcept {
    first.consider(tree.triangles[at], at, work.exact_decisions);
    return false;
  }
  void update(std::uint32_t, const Offset&) noexcept {}
};

}  // namespace

// The path is cut into parts, each in a ball about its middle. What can touch the probe on a part is within
// the part's half length and the radius of that middle.
std::optional<Impact> SphereTree::first_hit(const Sweep& sweep, Memory& memory, Work& work) const noexcept {
  if (!can_search(sweep.from) || !can_search(sweep.to)) return fallback().first_hit(sweep, work);
  const std::uint64_t before = work.total();
  if (!is_clear(sweep.from, sweep.radius, memory)) {
    const WithinBudget start = nearest_within_budget(sweep.from, sweep.radius, memory, work);
    if (start.exhausted) return fallback().first_hit(sweep, work);
    if (start.contact) return Impact{0, *start.contact};
  }
  const double length = (sweep.to - sweep.from).norm();
  const double reach = padded_sweep_radius(sweep, largest_difference(bounds_, sweep));
  if (is_clear(sweep.from, reach + length, memory)) return std::nullopt;
  const std::uint64_t budget = remaining(work_limit(), work.total() - before);
  SweepVisitor visitor{parts_, sweep, sweep.from, 0};
  constexpr double max_parts = 256;
  const double parts =
      std::clamp(std::ceil(length / (2 * std::max(sweep.radius, mean_leaf_radius_))), 1.0, max_parts);
  // The middle of a part is rounded to a point.
  const double ball = reach + position_error(sweep) + 0.5 * length / parts * (1 + 0x1p-40);
  for (double part = 0; part < parts && !(visitor.first.fraction() < part / parts); ++part) {
    visitor.center = position_at(sweep, (part + 0.5) / parts);
    visitor.limit = frame_.limit(ball * ball);
    if (traverse(frame_.point(visitor.center), visitor, budget) != spheres::exhausted) continue;
    visit_all(visitor);
    break;
  }
  work += visitor.work;
  return impact_of(visitor.first, parts_.triangles, ids_, certified_,
                   [&](double reach_at_start) { return nearest(sweep.from, reach_at_start, memory, work); });
}

}  // namespace touchmark
