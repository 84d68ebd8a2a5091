#include "core/haptics/coupling.h"

namespace touchmark {

Vec3 held_by_friction(const Vec3& from, const Vec3& target, const Vec3& goal,
                      const Coupling& coupling) noexcept {
  if (!coupling.has_friction()) return target;
  const double depth = (target - goal).norm(), tangential = (target - from).norm();
  if (tangential <= coupling.static_friction * depth) return from;
  const double short_by = coupling.dynamic_friction * depth;
  return tangential > short_by ? Vec3(target + (from - target) * (short_by / tangential)) : from;
}

Vec3 coupling_force(const Vec3& proxy, const Vec3& goal, const Vec3& goal_before,
                    const Coupling& coupling) noexcept {
  const Vec3 spring = coupling.stiffness * (proxy - goal);
  if (!(coupling.damping > 0)) return spring;
  return spring - (coupling.damping / coupling.tick_s) * (goal - goal_before);
}

}  // namespace touchmark
