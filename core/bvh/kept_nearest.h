/// What a session asks first: the triangle that was nearest, and those around it. That answers most ticks of
/// a hand, and lies in nine cache lines in a row.
#pragma once

#include <cstdint>
#include <optional>

#include "core/bvh/followed_point.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/search/memory/last_distance.h"

namespace touchmark::bvh {

/// Forgetting it changes the cost of the next answer, never the answer.
struct alignas(64) KeptNearest : LastDistance {
  /// So many more questions are for the mesh's box, which answered last.
  std::uint16_t for_box = 0;
  /// A triangle of the structure is kept. This is in the first line, which every query reads.
  bool is_kept = false;
  TriangleId id = 0;  ///< the kept triangle's
  FollowedPoint around;
  PreparedTriangle triangle;  ///< the kept one: a copy of that in around.nearest
  /// By which the point moved to `center`; infinite after `touches`, which lists nothing.
  Vec3 move = Vec3::Zero();

  /// Clears the kept triangle's bit in bits of those listed.
  unsigned others(unsigned listed) const noexcept { return listed & ~(1U << around.nearest); }
  /// The contact of a point with the kept triangle, which is `offset` away, if that is within the reach.
  std::optional<Contact> contact(const Vec3& point, const Vec3& offset, double distance,
                                 double reach) const noexcept {
    if (distance > reach) return std::nullopt;
    return Contact{point - offset, Vec3(offset / distance), distance, id, Side::unasked};
  }
};
static_assert(sizeof(KeptNearest) == 576);

}  // namespace touchmark::bvh
