/// Answers by the sampled distances alone.
#pragma once

#include <cstdint>

#include "core/point_queries/bounds.h"
#include "core/point_queries/memory.h"

namespace touchmark::queries {

/// True if nothing is within reach, by what was sampled. Then that is what is remembered of the point. The
/// tight bound is looked up only if the last query found nothing near, since it seldom helps where something
/// was.
[[gnu::always_inline]] inline bool rejects_by_distance_field(const WideBvh& bvh, const FilterPoint& point,
                                                             const Vec3& center, double reach,
                                                             PointMemory& memory) noexcept {
  double clearance = sampled_clearance(bvh, point);
  if (!(clearance > reach) && !memory.is_near() && bvh.distances().may_be_tighter(point))
    clearance = tight_sampled_clearance(bvh, point);
  if (!(clearance > reach)) return false;
  memory.center = center;
  memory.lower = clearance;
  memory.upper = std::numeric_limits<double>::infinity();
  return true;
}
/// Rejects once the point has its samples, two at most, which take no more than half of the work that a query
/// may take before it looks at every triangle. `budget` becomes what is left of it.
bool rejects_once_sampled(const WideBvh& bvh, const FilterPoint& point, const Vec3& center, double reach,
                          PointMemory& memory, std::uint64_t& budget, Work& work) noexcept;

}  // namespace touchmark::queries
