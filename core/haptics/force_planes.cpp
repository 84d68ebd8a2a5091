#include "core/haptics/force_planes.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "core/haptics/proxy_motion.h"

namespace touchmark {
namespace {

/// The nearest to `goal` of all x that no normal points away from. It is among the nearest on each face, edge
/// and corner of that cone, those that are in the cone, and of these the nearest.
Vec3 nearest_in_cone(std::span<const Vec3, 3> normals, const Vec3& goal) noexcept {
  Vec3 nearest = Vec3::Zero();
  double least = goal.squaredNorm();
  const auto consider = [&](const Vec3& x, std::size_t on, std::size_t and_on) {
    for (std::size_t k = 0; k < normals.size(); ++k)
      if (k != on && k != and_on && normals[k].dot(x) < 0) return;
    const double squared = (goal - x).squaredNorm();
    if (!(squared < least)) return;
    least = squared;
    nearest = x;
  };
  constexpr std::size_t none = 3;
  consider(goal, none, none);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    consider(goal - normals[i].dot(goal) * normals[i], i, i);
    for (std::size_t j = i + 1; j < normals.size(); ++j) {
      const Vec3 edge = normals[i].cross(normals[j]);
      const double squared = edge.squaredNorm();
      if (squared > 0) consider(edge.dot(goal) / squared * edge, i, j);
    }
  }
  return nearest;
}

void store(const Vec3& from, std::array<double, 3>& to) noexcept { to = {from.x(), from.y(), from.z()}; }
Vec3 vector_of(const std::array<double, 3>& from) noexcept { return Vec3(from.data()); }

}  // namespace

ForcePlanes::ForcePlanes(const ProxyState& state, const Vec3& goal, const Coupling& coupling) noexcept
    : stiffness_(coupling.stiffness),
      static_friction_(coupling.static_friction),
      dynamic_friction_(coupling.dynamic_friction) {
  if (state.contacts == 0) return;
  store(state.position, position_);
  store(state.force, force_);
  for (std::size_t i = 0; i < state.contacts; ++i) store(state.normals[i], normals_[i]);
  const Spring spring = spring_to(goal);
  store(spring.force, spring_);
  depth_ = spring.depth;
}

ForcePlanes::Spring ForcePlanes::spring_to(const Vec3& goal) const noexcept {
  const std::array<Vec3, 3> normals{vector_of(normals_[0]), vector_of(normals_[1]), vector_of(normals_[2])};
  const Vec3 to_goal = goal - vector_of(position_);
  const Vec3 off_planes = nearest_in_cone(normals, to_goal);
  const Vec3 held =
      held_by_friction(Vec3::Zero(), off_planes, to_goal,
                       {.static_friction = static_friction_, .dynamic_friction = dynamic_friction_});
  return {stiffness_ * (held - to_goal), (off_planes - to_goal).norm()};
}

Vec3 ForcePlanes::force(const Vec3& goal) const noexcept {
  if (!goal.allFinite()) return Vec3::Zero();
  const Spring now = spring_to(goal);
  const double gone = depth_ > 0 ? 1 - std::min(now.depth / depth_, 1.0) : 0;
  const Vec3 tick = vector_of(force_), spring = vector_of(spring_);
  return tick + (now.force - spring) - gone * (tick - spring);
}

}  // namespace touchmark
