/// The triangle that a moving ball touches first while the mesh moves, too, and the impact on it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/mesh_motion.h"
#include "core/probe.h"
#include "core/triangle_ids.h"

namespace touchmark {

/// Keeps the smallest fraction, then the lowest index, so that triangles may come in any order and more than
/// once.
class FirstMovingTouch {
 public:
  /// Both must outlive this.
  FirstMovingTouch(const Sweep& sweep, const MeshMotion& motion) noexcept : sweep_(sweep), motion_(motion) {}

  /// Looks at a triangle, which must outlive this, as it is before it moves; counts where whole numbers
  /// decide.
  void consider(const PreparedTriangle& triangle, std::uint64_t& exact_decisions) noexcept;
  /// Returns the impact, whose contact is that of the probe and the triangle as they are then, or nothing.
  std::optional<Impact> impact(const TriangleIds& ids) const noexcept;

 private:
  std::optional<double> fraction_of(const PreparedTriangle& triangle,
                                    std::uint64_t& exact_decisions) const noexcept;

  const Sweep& sweep_;
  const MeshMotion& motion_;
  const PreparedTriangle* triangle_ = nullptr;
  double fraction_ = std::numeric_limits<double>::infinity();
};

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
