/// The triangle that a moving ball touches first, of those that a search looks at, and the impact on it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "core/detector.h"
#include "core/geometry/moving_triangle_sweep.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/mesh_motion.h"
#include "core/probe.h"
#include "core/search/tracing.h"
#include "core/triangle_ids.h"

namespace touchmark {

/// Keeps the smallest fraction, then the lowest index, so that triangles may come in any order and more than
/// once.
class FirstTouch {
 public:
  /// The sweep must outlive this.
  explicit FirstTouch(const Sweep& sweep) noexcept : sweep_(sweep) {}
  explicit FirstTouch(const Sweep&&) = delete;

  const Sweep& sweep() const noexcept { return sweep_; }
  bool found() const noexcept { return fraction_ <= 1; }
  double fraction() const noexcept { return fraction_; }
  std::uint32_t slot() const noexcept { return slot_; }
  /// Returns the part of the path that is still to be looked at.
  double limit() const noexcept { return std::min(fraction_, 1.0); }

  /// Leaves nothing of the path to look at.
  void give_up() noexcept { fraction_ = -1; }
  /// Looks at the triangle in this slot; counts where whole numbers decide.
  void consider(const PreparedTriangle& triangle, std::uint32_t slot,
                std::uint64_t& exact_decisions) noexcept {
    if constexpr (tracing) note_triangle(triangle.index);
    take(sweep_hit(triangle, sweep_, limit(), exact_decisions), triangle.index, slot);
  }
  /// Likewise while the mesh moves.
  void consider_moving(const PreparedTriangle& triangle, std::uint32_t slot, const MeshMotion& motion,
                       std::uint64_t& exact_decisions) noexcept {
    if (!has_moved(triangle, motion.after())) return consider(triangle, slot, exact_decisions);
    const TriangleCorners after = motion.corners_at(triangle.index, 1);
    take(moving_sweep_hit(triangle.corner, after, sweep_, limit(), exact_decisions), triangle.index, slot);
  }

 private:
  [[gnu::always_inline]] void take(const std::optional<double>& fraction, std::uint32_t index,
                                   std::uint32_t slot) noexcept {
    if (!fraction || !(*fraction < fraction_ || (*fraction == fraction_ && index < index_))) return;
    fraction_ = *fraction;
    index_ = index;
    slot_ = slot;
  }

  const Sweep& sweep_;
  double fraction_ = std::numeric_limits<double>::infinity();
  std::uint32_t index_ = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t slot_ = 0;
};

/// Ends a search for `first_hit`: returns the impact, or nothing. Of all the triangles that are touched at
/// the start the nearest one counts: nearest(reach) looks for it. Where contact is decided by doubles, these
/// may find it beyond the radius, so that any reach will do.
template <class Nearest>
std::optional<Impact> impact_of(const FirstTouch& first, std::span<const PreparedTriangle> triangles,
                                const TriangleIds& ids, bool decides_exactly,
                                const Nearest& nearest) noexcept {
  if (!first.found()) return std::nullopt;
  const Sweep& sweep = first.sweep();
  if (first.fraction() == 0) {
    const double reach = decides_exactly ? sweep.radius : std::numeric_limits<double>::infinity();
    if (const std::optional<Contact> start = nearest(reach)) return Impact{0, *start};
  }
  const PreparedTriangle& triangle = triangles[first.slot()];
  return Impact{first.fraction(), contact_on_path(triangle, sweep, first.fraction(), ids[triangle.index])};
}

/// Ends a search for `first_hit_moving`: the contact is that of the probe and the triangle as they are then.
std::optional<Impact> moving_impact_of(const FirstTouch& first, std::span<const PreparedTriangle> triangles,
                                       const TriangleIds& ids, const MeshMotion& motion) noexcept;

/// A ball about the middle of a sweep that holds, where the mesh is before it moves, all that can be met.
struct MovingReach {
  Vec3 center;
  double reach;

  MovingReach(const Sweep& sweep, const MeshMotion& motion) noexcept
      : center(position_at(sweep, 0.5)),
        reach((sweep.radius + (sweep.to - sweep.from).norm() / 2 + motion.max_shift()) * (1 + 0x1p-40) +
              position_error(sweep)) {}
};

}  // namespace touchmark
