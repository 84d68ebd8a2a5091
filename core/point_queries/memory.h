/// What the queries of a session remember of a hierarchy, and what follows from that without a look into it.
#pragma once

#include <cstdint>
#include <limits>

#include "core/bvh/kept_nearest.h"
#include "core/bvh/wide_bvh.h"
#include "core/point_queries/leaf_cache.h"
#include "core/point_queries/neighborhood.h"
#include "core/search/memory/last_distance.h"
#include "core/search/plane_filter/plane_filter.h"

namespace touchmark::queries {

/// What a haptic point remembers between ticks: 11 KB. The lower bound holds with all rounding included; the
/// upper one is the computed distance of the triangle in `slot`.
struct PointMemory : bvh::KeptNearest {
  /// A place that was found to be farther from the mesh than a radius, exactly; below 0: there is none.
  Vec3 free_center = Vec3::Zero();
  double free_radius = -1;
  LeafCache cache;            ///< leaves that `nearest` listed
  Neighborhood neighborhood;  ///< triangles that `contacts` and sweeps listed
  /// The planes of the triangle that `touches` found last, in one line, and its slot.
  TrianglePlanes touched{};
  std::uint32_t touched_slot = std::numeric_limits<std::uint32_t>::max();

  /// Becomes as a new one is, and that in a few stores.
  void start_anew() noexcept {
    static_cast<LastDistance&>(*this) = {};
    around.start_anew();
    move = free_center = Vec3::Zero();
    free_radius = -1;
    cache.start_anew();
    neighborhood.start_anew();
    touched_slot = std::numeric_limits<std::uint32_t>::max();
    for_box = 0;
    is_kept = false;
  }
  /// Forgets what is about another structure.
  void claim(const Epoch& now) noexcept {
    if (epoch == now) return;
    start_anew();
    epoch = now;
  }
  /// True if a ball there is known not to touch.
  bool knows_free(const Vec3& at, double radius) const noexcept {
    return radius <= free_radius && at == free_center;
  }
  /// Remembers bounds of the distance that no query for the nearest found.
  void remember(const Vec3& at, double at_least, double at_most) noexcept {
    move = Vec3::Constant(std::numeric_limits<double>::infinity());
    center = at;
    lower = at_least;
    upper = at_most;
  }
};

/// True if no triangle is known to be within reach. The distance changes by no more than the point moves. Of
/// a hierarchy that holds nothing, nothing is known.
inline bool is_clear(const WideBvh& bvh, const Vec3& center, double reach,
                     const PointMemory& memory) noexcept {
  const double margin = memory.lower - reach;
  return memory.epoch == bvh.epoch() && margin > 0 &&
         (center - memory.center).squaredNorm() < margin * margin;
}
/// True if that is known of a whole path. A ball that holds both its ends holds all of it.
inline bool is_clear(const WideBvh& bvh, const Sweep& sweep, const PointMemory& memory) noexcept {
  return is_clear(bvh, sweep.from, sweep.radius, memory) && is_clear(bvh, sweep.to, sweep.radius, memory);
}
/// True if that is known of one of many points.
inline bool is_clear(const WideBvh& bvh, const Vec3& center, double reach,
                     const bvh::FollowedPoint& point) noexcept {
  const double margin = point.covered - reach;
  return point.epoch == bvh.epoch() && point.list.count == 0 && margin > 0 &&
         (center - point.center).squaredNorm() < margin * margin;
}
/// True if a triangle is known to be within the radius. The point and that triangle are within some radii of
/// the mesh then, where clearance_pad is less than this pad and grows by less than this factor.
inline bool is_touching(const WideBvh& bvh, const Vec3& center, double radius,
                        const PointMemory& memory) noexcept {
  const double margin = (radius - 0x1p-40 * bvh.radius()) * (1 - 0x1p-38) - memory.upper;
  return memory.epoch == bvh.epoch() && margin > 0 &&
         (center - memory.center).squaredNorm() < margin * margin;
}
/// Remembers how far the mesh's box is, as a clearance. The next questions are for the box where the point
/// moves too fast for that to be of use.
[[gnu::noinline, gnu::cold]] void remember_box(const WideBvh& bvh, const Vec3& center, double reach,
                                               double clearance, PointMemory& memory) noexcept;
/// True if nothing was near, and nothing is within reach by the mesh's box, which then is remembered.
[[gnu::always_inline]] inline bool turns_out_beyond_box(const WideBvh& bvh, const Vec3& center, double reach,
                                                        PointMemory& memory) noexcept {
  if (memory.epoch == bvh.epoch() && memory.is_near()) return false;
  const double clearance = bvh.clearance_by_box(center);
  if (!(clearance > reach)) return false;
  remember_box(bvh, center, reach, clearance, memory);
  return true;
}
[[gnu::always_inline]] inline bool turns_out_beyond_box(const WideBvh& bvh, const Sweep& sweep,
                                                        PointMemory& memory) noexcept {
  return bvh.is_beyond_box(sweep) && turns_out_beyond_box(bvh, sweep.to, sweep.radius, memory);
}
/// Goes on with the box if that has answered; returns whether it has.
inline bool goes_on_with_box(bool is_beyond, PointMemory& memory) noexcept {
  is_beyond ? --memory.for_box : memory.for_box = 0;
  return is_beyond;
}
/// True if nothing is within reach, as far as that is known without looking into the tree. By what was near
/// last, or by the mesh's box, first where that answered last.
[[gnu::always_inline]] inline bool is_clear_at_once(const WideBvh& bvh, const Vec3& center, double reach,
                                                    PointMemory& memory) noexcept {
  if (memory.for_box == 0)
    return is_clear(bvh, center, reach, memory) || turns_out_beyond_box(bvh, center, reach, memory);
  return goes_on_with_box(bvh.is_beyond_box(center, reach), memory);
}
/// True if that is known of a whole path.
[[gnu::always_inline]] inline bool is_clear_at_once(const WideBvh& bvh, const Sweep& sweep,
                                                    PointMemory& memory) noexcept {
  if (memory.for_box == 0) return is_clear(bvh, sweep, memory) || turns_out_beyond_box(bvh, sweep, memory);
  return goes_on_with_box(bvh.is_beyond_box(sweep), memory);
}
/// Bounds the distance from below by what is remembered; 0 where nothing is.
inline double clearance(const WideBvh& bvh, const Vec3& center, const PointMemory& memory) noexcept {
  if (memory.epoch != bvh.epoch()) return 0;
  const double moved = (center - memory.center).norm() * (1 + 0x1p-50);
  return (memory.lower - moved) * (1 - 0x1p-50);
}

}  // namespace touchmark::queries
