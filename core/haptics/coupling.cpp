#include "core/haptics/coupling.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace touchmark {

void expect_usable(const Coupling& coupling) {
  const std::array<std::pair<const char*, double>, 6> members{
      {{"radius", coupling.radius},
       {"stiffness", coupling.stiffness},
       {"static_friction", coupling.static_friction},
       {"dynamic_friction", coupling.dynamic_friction},
       {"damping", coupling.damping},
       {"tick_s", coupling.tick_s}}};
  for (const auto& [name, value] : members) {
    if (value >= 0 && std::isfinite(value)) continue;
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                "; it must be finite, and 0 or more");
  }
  if (coupling.tick_s == 0) throw std::invalid_argument("tick_s is 0; a tick takes time");
  if (coupling.dynamic_friction > coupling.static_friction) {
    throw std::invalid_argument("dynamic_friction is " + std::to_string(coupling.dynamic_friction) +
                                ", more than static_friction, " + std::to_string(coupling.static_friction));
  }
}

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
