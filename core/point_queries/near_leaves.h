/// Searches among the leaves that a haptic point has listed (leaf_cache.h), where they are all that can be
/// near.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/bvh/search.h"
#include "core/point_queries/bounds.h"
#include "core/point_queries/memory.h"

namespace touchmark::queries {

/// A point that moves by more of the mean leaf's radius a tick starts anew: it has left the listed leaves
/// before they are used.
inline constexpr double max_move_in_leaf_radii = 4;

/// True if a point that moves so far a tick stays among the leaves that are listed for it.
inline bool stays_among_listed_leaves(const WideBvh& bvh, const Vec3& move) noexcept {
  return move.norm() <= max_move_in_leaf_radii * bvh.mean_leaf_radius();
}
/// Returns at least the distance between two points of the mesh's frame, in the tree's.
inline float displacement(const WideBvh& bvh, const Vec3& from, const Vec3& to,
                          const FilterPoint& at) noexcept {
  return static_cast<float>(bvh.frame().scale() * (to - from).norm()) + 2 * at.plane_error;
}
/// True if a list for ticks ahead is worth its making, where a tick is so long and the nearest that far. A
/// point that moves faster leaves it too soon. Far from the mesh a descent costs more, and so a list pays for
/// longer ticks.
inline bool pays_to_list(const WideBvh& bvh, float step, float distance) noexcept {
  constexpr float of_leaf_radius = 0.25F, of_distance = 0.1F;
  return step <= of_leaf_radius * static_cast<float>(bvh.frame().scale() * bvh.mean_leaf_radius()) +
                     of_distance * distance;
}
/// Lists the leaves for as many ticks ahead as there is capacity for, around a point ahead: a point that goes
/// on as it moved comes to it and then leaves it. Returns false where lists do not pay, or within the budget.
bool refill(const WideBvh& bvh, const Vec3& center, const Vec3& move, float distance, PointMemory& memory,
            std::uint64_t budget, Work& work) noexcept;
/// Lists the leaves if the next tick would leave those listed.
void refill_ahead(const WideBvh& bvh, PointMemory& memory, Work& work) noexcept;

template <class Visitor>
[[gnu::always_inline]] inline float search_leaves(const WideBvh& bvh, const FilterPoint& point,
                                                  Visitor& visitor, const LeafCache& cache, float away,
                                                  std::uint64_t budget) noexcept {
  return bvh::with_isa(bvh.simd(), [&](auto isa) {
    return isa.search_leaves(bvh.parts(), point, cache, away, budget, visitor);
  });
}

/// Searches the listed leaves when they are all that can be within the limit. When they are not, lists them
/// anew where that pays, else descends.
template <class Visitor>
[[gnu::always_inline]] inline float search_near(const WideBvh& bvh, const FilterPoint& point,
                                                Visitor& visitor, PointMemory& memory,
                                                std::uint64_t budget) noexcept {
  const float distance = std::sqrt(visitor.limit) + point.plane_error;
  LeafCache& cache = memory.cache;
  float away = displacement(bvh, cache.center, visitor.center, point);
  if (!(distance + away < cache.covered_radius) &&
      pays_to_list(bvh, displacement(bvh, memory.center, visitor.center, point), distance) &&
      refill(bvh, visitor.center, visitor.center - memory.center, distance, memory,
             std::min(budget, max_refill_work(bvh)), visitor.work))
    away = displacement(bvh, cache.center, visitor.center, point);
  const Work before = visitor.work;
  if (!(distance + away < cache.covered_radius)) {
    const float unseen = bvh::traverse(bvh, point, visitor, budget);
    cache.count_descent(visitor.work.spheres - before.spheres, visitor.work.triangles - before.triangles);
    return unseen;
  }
  const float unseen = search_leaves(bvh, point, visitor, cache, away, budget);
  cache.count_search(visitor.work.spheres - before.spheres, visitor.work.triangles - before.triangles);
  return unseen;
}

/// As search_near, for a search whose budget another has partly spent: it lists no leaves anew, and looks at
/// the listed ones only where it may look at all of them.
template <class Visitor>
[[gnu::always_inline]] inline float search_listed(const WideBvh& bvh, const FilterPoint& point,
                                                  Visitor& visitor, const PointMemory& memory,
                                                  std::uint64_t budget) noexcept {
  const float distance = std::sqrt(visitor.limit) + point.plane_error;
  const float away = displacement(bvh, memory.cache.center, visitor.center, point);
  const std::uint64_t all = (1 + bvh::width) * (memory.cache.count + std::uint64_t{bvh::width});
  if (!(distance + away < memory.cache.covered_radius) || all > budget)
    return bvh::traverse(bvh, point, visitor, budget);
  return search_leaves(bvh, point, visitor, memory.cache, away, budget);
}

}  // namespace touchmark::queries
