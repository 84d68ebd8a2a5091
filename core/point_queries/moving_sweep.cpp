/// The first triangle that a moving ball touches while the mesh moves.
#include <cstdint>
#include <limits>

#include "core/bvh/search.h"
#include "core/geometry/distance_error.h"
#include "core/point_queries/bounds.h"
#include "core/point_queries/queries.h"
#include "core/search/first_moving_touch.h"

namespace touchmark::queries {
namespace {

/// Keeps the first touch of the triangles within a ball.
struct MovingVisitor {
  Vec3 center;
  FirstMovingTouch& first;
  const bvh::Parts& parts;
  float limit;
  LimitedWork work{};

  bool accepts(std::uint32_t) const noexcept { return true; }
  void update(std::uint32_t at, const Offset&) noexcept {
    first.consider(parts.triangles[at], work.exact_decisions);
  }
};

}  // namespace

std::optional<Impact> first_hit_moving(const Surface& surface, const Sweep& sweep, const MeshMotion& motion,
                                       LimitedWork& work) noexcept {
  const WideBvh& bvh = surface.bvh;
  if (!(sweep.radius >= 0)) return std::nullopt;
  const auto [center, reach] = MovingReach(sweep, motion);
  if (!bvh.can_search(center))
    return scan_of(bvh, surface.certified, work).first_hit_moving(sweep, motion, work);
  if (bvh.is_beyond_box(center, reach)) return std::nullopt;
  FirstMovingTouch first(sweep, motion);
  const double farthest = reach + distance_error(bvh.bounds(), center);
  MovingVisitor visitor{center, first, bvh.parts(), bvh.frame().limit(farthest * farthest)};
  bvh::traverse(bvh, bvh.frame().point(center), visitor, std::numeric_limits<std::uint64_t>::max());
  work.take(visitor.work);
  return first.impact(bvh.ids());
}

}  // namespace touchmark::queries
