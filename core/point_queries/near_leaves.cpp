#include "core/point_queries/near_leaves.h"

namespace touchmark::queries {
namespace {

/// The next tick may be this much longer than the last one and still need no refill.
constexpr float ticks_prepared = 2;

}  // namespace

bool refill(const WideBvh& bvh, const Vec3& center, const Vec3& move, float distance, PointMemory& memory,
            std::uint64_t budget, Work& work) noexcept {
  // With fewer ticks refills cost more, with more the fuller cache does.
  constexpr float min_ticks = 2, max_ticks = 16;
  constexpr double ahead = 0.5;  // of the ticks
  LeafCache& cache = memory.cache;
  if (!cache.may_refill()) return false;
  const std::uint64_t spheres_before = work.spheres;
  const auto step = static_cast<float>(bvh.frame().scale() * move.norm());
  for (;;) {
    Vec3 cache_center = center + ahead * double{cache.horizon_ticks} * move;
    if (!bvh.can_search(cache_center)) cache_center = center;
    const FilterPoint point = bvh.frame().point(cache_center);
    cache.start(cache_center, distance + cache.horizon_ticks * step + 8 * point.plane_error);
    if (bvh::with_isa(bvh.simd(),
                      [&](auto isa) { return isa.list_leaves(bvh.parts(), point, budget, cache, work); }))
      break;
    if (cache.horizon_ticks <= min_ticks) {
      // What was left out may be anywhere.
      cache.forget();
      cache.backoff.failed();
      return false;
    }
    cache.horizon_ticks = std::max(0.5F * cache.horizon_ticks, min_ticks);
  }
  cache.count_refill(work.spheres - spheres_before);
  if (cache.count <= LeafCache::few) cache.horizon_ticks = std::min(1.25F * cache.horizon_ticks, max_ticks);
  return true;
}

void refill_ahead(const WideBvh& bvh, PointMemory& memory, Work& work) noexcept {
  if (!stays_among_listed_leaves(bvh, memory.move) || memory.cache.backoff.left > 0) return;
  const FilterPoint point = bvh.frame().point(memory.center);
  const float distance = static_cast<float>(bvh.frame().scale() * memory.upper) + 2 * point.plane_error;
  // A tick's move counts twice: so much farther may the nearest be, and so much farther is the cache's
  // center.
  const auto two_moves = static_cast<float>(2 * bvh.frame().scale() * memory.move.norm());
  const float away = displacement(bvh, memory.cache.center, memory.center, point);
  if (distance + away + ticks_prepared * two_moves < memory.cache.covered_radius) return;
  Work spent;
  refill(bvh, memory.center, memory.move, distance, memory, max_work(bvh), spent);
  work += spent;
}

}  // namespace touchmark::queries
