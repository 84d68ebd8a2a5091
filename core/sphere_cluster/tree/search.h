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
  switch (simd_) {
    case Simd::avx512:
      return spheres::avx512::traverse(parts_, point, budget, visitor);
    case Simd::avx2:
      return spheres::avx2::traverse(parts_, point, budget, visitor);
    default:
      return spheres::portable::traverse(parts_, point, budget, visitor);
  }
}

inline float SphereTree::displacement(const Vec3& from, const Vec3& to,
                                      const FilterPoint& at) const noexcept {
  return static_cast<float>(frame_.scale() * (to - from).norm()) + 2 * at.plane_error;
}

/// Searches the cached leaves when they are all that can be within the limit, and refills the cache when they
/// are not.
template <class Visitor>
[[gnu::always_inline]] inline float SphereTree::search_near(const FilterPoint& point, Visitor& visitor,
                                                            Memory& memory,
                                                            std::uint64_t budget) const noexcept {
  const float distance = std::sqrt(visitor.limit) + point.plane_error;
  float away = displacement(memory.cache.center, visitor.center, point);
  if (!(distance + away < memory.cache.covered_radius)) {
    if (!refill(visitor.center, visitor.center - memory.center, distance, memory, budget, visitor.work))
      return traverse(point, visitor, budget);
    away = displacement(memory.cache.center, visitor.center, point);
    if (!(distance + away < memory.cache.covered_radius)) return traverse(point, visitor, budget);
  }
  return search_cached(point, visitor, memory.cache, away, budget);
}

template <class Visitor>
[[gnu::always_inline]] inline float SphereTree::search_cached(const FilterPoint& point, Visitor& visitor,
                                                              const spheres::LeafCache& cache, float away,
                                                              std::uint64_t budget) const noexcept {
  switch (simd_) {
    case Simd::avx512:
      return spheres::avx512::search_cached(parts_, point, cache, away, budget, visitor);
    case Simd::avx2:
      return spheres::avx2::search_cached(parts_, point, cache, away, budget, visitor);
    default:
      return spheres::portable::search_cached(parts_, point, cache, away, budget, visitor);
  }
}

}  // namespace touchmark
