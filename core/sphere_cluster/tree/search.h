/// The parts of SphereTree that depend on what a search is for. A visitor has
///   center      where the search is from
///   limit       squared, in the tree's frame: only triangles within it need to be shown; may fall meanwhile
///   work        counts
///   accepts(at)   does it ask for the triangle in that slot
///   update(at, offset)   learns of a triangle that it asked for
/// Always inline: what they call is a function for each instruction set, and no more call is wanted before
/// it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/traversal.h"

namespace touchmark {

template <class Visitor>
[[gnu::always_inline]] inline void SphereTree::visit(std::uint32_t at, Visitor& visitor) const noexcept {
  ++visitor.work.triangles;
  simd_ == Simd::portable ? spheres::portable::visit(parts_, at, visitor)
                          : spheres::avx2::visit(parts_, at, visitor);
}

template <class Visitor>
[[gnu::always_inline]] inline float SphereTree::traverse(const FilterPoint& point, Visitor& visitor,
                                                         std::uint64_t budget) const noexcept {
  return simd_ == Simd::portable ? spheres::portable::traverse(parts_, point, budget, visitor)
                                 : spheres::avx2::traverse(parts_, point, budget, visitor);
}

inline float SphereTree::displacement(const Vec3& from, const Vec3& to,
                                      const FilterPoint& at) const noexcept {
  return static_cast<float>(frame_.scale() * (to - from).norm()) + 2 * at.plane_error;
}

/// Is nothing within reach, by what was sampled? Then that is what is remembered of the point. It asks the
/// tight bound where nothing was near, for else something still is, as a rule.
[[gnu::always_inline]] inline bool SphereTree::rejects_by_distance_field(const FilterPoint& point,
                                                                         const Vec3& center, double reach,
                                                                         Memory& memory) const noexcept {
  double clearance = static_cast<double>(distances_.lower_bound(point)) * frame_.unit();
  if (!(clearance > reach) && !memory.is_near() && distances_.may_be_tighter(point))
    clearance = static_cast<double>(distances_.tight_lower_bound(point)) * frame_.unit();
  if (!(clearance > reach)) return false;
  memory.center = center;
  memory.lower = clearance;
  memory.upper = std::numeric_limits<double>::infinity();
  return true;
}

/// Is a list for ticks ahead worth its making, where a tick is so long and the nearest that far? A point that
/// moves faster leaves it too soon. Far from the mesh a descent costs more, and so a list pays for longer
/// ticks.
inline bool SphereTree::pays_to_list(float step, float distance) const noexcept {
  constexpr float of_leaf_radius = 0.25F, of_distance = 0.1F;
  return step <=
         of_leaf_radius * static_cast<float>(frame_.scale() * mean_leaf_radius_) + of_distance * distance;
}

/// Searches the cached leaves when they are all that can be within the limit. When they are not, it refills
/// the cache where that pays, else descends.
template <class Visitor>
[[gnu::always_inline]] inline float SphereTree::search_near(const FilterPoint& point, Visitor& visitor,
                                                            Memory& memory,
                                                            std::uint64_t budget) const noexcept {
  const float distance = std::sqrt(visitor.limit) + point.plane_error;
  spheres::LeafCache& cache = memory.cache;
  float away = displacement(cache.center, visitor.center, point);
  if (!(distance + away < cache.covered_radius) &&
      pays_to_list(displacement(memory.center, visitor.center, point), distance) &&
      refill(visitor.center, visitor.center - memory.center, distance, memory,
             std::min(budget, refill_limit()), visitor.work))
    away = displacement(cache.center, visitor.center, point);
  const Work before = visitor.work;
  if (!(distance + away < cache.covered_radius)) {
    const float unseen = traverse(point, visitor, budget);
    cache.count_descent(visitor.work.spheres - before.spheres, visitor.work.triangles - before.triangles);
    return unseen;
  }
  const float unseen = search_cached(point, visitor, cache, away, budget);
  cache.count_search(visitor.work.spheres - before.spheres, visitor.work.triangles - before.triangles);
  return unseen;
}

/// As search_near, for a search whose budget another has partly spent: it lists no leaves anew, and looks at
/// the listed ones only where it may look at all of them.
template <class Visitor>
[[gnu::always_inline]] inline float SphereTree::search_listed(const FilterPoint& point, Visitor& visitor,
                                                              const Memory& memory,
                                                              std::uint64_t budget) const noexcept {
  const float distance = std::sqrt(visitor.limit) + point.plane_error;
  const float away = displacement(memory.cache.center, visitor.center, point);
  const std::uint64_t all =
      (1 + spheres::tree_width) * (memory.cache.count + std::uint64_t{spheres::tree_width});
  if (!(distance + away < memory.cache.covered_radius) || all > budget)
    return traverse(point, visitor, budget);
  return search_cached(point, visitor, memory.cache, away, budget);
}

template <class Visitor>
[[gnu::always_inline]] inline float SphereTree::search_cached(const FilterPoint& point, Visitor& visitor,
                                                              const spheres::LeafCache& cache, float away,
                                                              std::uint64_t budget) const noexcept {
  return simd_ == Simd::portable
             ? spheres::portable::search_cached(parts_, point, cache, away, budget, visitor)
             : spheres::avx2::search_cached(parts_, point, cache, away, budget, visitor);
}

}  // namespace touchmark
