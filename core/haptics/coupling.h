/// What a haptic program sets of a proxy, and the forces that follow from it. Lengths are in mesh units,
/// forces in N; a stiffness is in N a mesh unit.
#pragma once

#include <cstdint>

#include "core/probe.h"

namespace touchmark {

/// How a device's tip, the goal, is coupled to its proxy. Zero turns a part off.
struct Coupling {
  double radius = 0;            ///< the ball's, mesh units; 0: the bare point
  double stiffness = 1000;      ///< N a mesh unit, of the spring between proxy and goal
  double static_friction = 0;   ///< coefficient, of Coulomb's friction at rest
  double dynamic_friction = 0;  ///< coefficient, in motion; at most the static one
  double damping = 0;           ///< N s a mesh unit, against the goal's velocity while in contact
  double tick_s = 0.001;        ///< seconds a tick of the servo loop
  double shading = 0;           ///< share, 0 to 1, of the way to the interpolated normal that the force turns
  std::uint64_t max_work =
      0;  ///< a step's, as LimitedWork::spent() counts it, for a detector that KeepsToLimit

  bool has_friction() const noexcept { return static_friction > 0 || dynamic_friction > 0; }
};

/// Throws std::invalid_argument naming the member that is below zero or not finite, a tick that takes no
/// time, or a dynamic friction above the static one.
void expect_usable(const Coupling& coupling);

/// Returns where friction lets the proxy come to on its way to `target`, the optimum without it: a cone about
/// the spring (W. Harwin and N. Melder, "Improved haptic rendering for multi-finger manipulation using
/// friction cone based god-objects", Eurohaptics 2002). It sticks at `from` while the way is within the
/// static coefficient times the depth of the goal, and else stops short of the target by the dynamic one.
Vec3 held_by_friction(const Vec3& from, const Vec3& target, const Vec3& goal,
                      const Coupling& coupling) noexcept;

/// Returns the force of spring and damper on a device at `goal` whose proxy is held at `proxy`.
Vec3 coupling_force(const Vec3& proxy, const Vec3& goal, const Vec3& goal_before,
                    const Coupling& coupling) noexcept;

}  // namespace touchmark
