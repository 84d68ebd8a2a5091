#include "core/scene/clearance.h"

namespace touchmark {

double Clearance::remaining(const Vec3& point, const SceneBodies& bodies) const noexcept {
  // A few roundings of the way and of both differences; what is not a number clears nothing.
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const double spent = (point - center).norm() + (bodies.motion() - motion);
  return lower - spent - rounding * (spent + (lower < 0x1p1000 ? lower : 0));
}

}  // namespace touchmark
