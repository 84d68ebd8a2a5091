/// What a session asks first: the triangle that was nearest, and those around it. That answers most ticks of
/// a hand, and lies in nine cache lines in a row.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/bvh/followed_point.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/search/memory/last_distance.h"

namespace touchmark::bvh {

/// Forgetting it changes the cost of the next answer, never the answer.
struct alignas(64) KeptNearest : LastDistance {
  /// So many more questions are for the mesh's box, which answered last.
  std::uint32_t for_box = 0;
  TriangleId id = 0;  ///< the kept triangle's
  FollowedPoint around;
  PreparedTriangle triangle;  ///< a copy of that in around.nearest, unless none is kept
  /// By which the point moved to `center`; infinite after `touches`, which lists nothing.
  Vec3 move = Vec3::Zero();

  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  /// True if a triangle of this structure is kept.
  bool keeps(const Epoch& structure) const noexcept {
    return around.epoch == structure && around.nearest != nowhere;
  }
  /// Clears the kept triangle's bit in bits of those listed.
  unsigned others(unsigned listed) const noexcept { return listed & ~(1U << around.nearest); }
  /// The contact of a point with the kept triangle, which is `offset` away, if that is within the reach.
  std::optional<Contact> contact(const Vec3& point, const Vec3& offset, double distance,
                                 double reach) const noexcept {
    if (distance > reach) return std::nullopt;
    return Contact{point - offset, Vec3(offset / distance), distance, id, Side::unasked};
  }
  /// What is listed is no longer asked, but tells where the point came from.
  void keep_none() noexcept { around.nearest = nowhere; }
};
static_assert(sizeof(KeptNearest) == 576);

}  // namespace touchmark::bvh
