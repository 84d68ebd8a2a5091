/// The force of a proxy between two of its ticks, by the planes that hold it. No question is asked.
#pragma once

#include <array>
#include <type_traits>

#include "core/haptics/coupling.h"
#include "core/probe.h"

namespace touchmark {

struct ProxyState;

/// A copy of what one tick came to, for devices that are faster than the proxy's loop (M. Ortega, S. Redon
/// and S. Coquillart, "A six degree-of-freedom god-object method for haptic display of rigid bodies with
/// surface properties", IEEE TVCG 2007). It refers to nothing, and is plain numbers: one thread may hand it
/// to another.
class ForcePlanes {
 public:
  ForcePlanes() noexcept = default;  ///< no planes: no force
  ForcePlanes(const ProxyState& state, const Vec3& goal, const Coupling& coupling) noexcept;

  /// Returns the force on a device at `goal`, N: that of a proxy which stays off these planes, and is held by
  /// friction, as it was when they were copied. At the tick's own goal it is the tick's force to the bit. It
  /// is 0 where the goal has left all planes, where there are none, and where the goal is no number. What the
  /// tick's force had besides, damping and shading, stays as it was, and goes as the goal leaves.
  Vec3 force(const Vec3& goal) const noexcept;

 private:
  using Numbers = std::array<double, 3>;
  struct Spring {
    Vec3 force;
    double depth;  ///< The goal is so far behind the planes.
  };
  Spring spring_to(const Vec3& goal) const noexcept;

  Numbers position_{};                ///< the proxy's
  std::array<Numbers, 3> normals_{};  ///< out of the surface; zero: there is no such plane
  double stiffness_ = 0, static_friction_ = 0, dynamic_friction_ = 0;
  Numbers force_{}, spring_{};  ///< the tick's, and what of it was the spring's
  double depth_ = 0;            ///< The tick's goal was so far behind the planes.
};
static_assert(std::is_trivially_copyable_v<ForcePlanes>);

}  // namespace touchmark
