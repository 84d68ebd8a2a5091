/// What every rival needs before it can be asked: most of them square, add or quantise whatever they get.
#pragma once

#include <algorithm>
#include <limits>

#include "core/geometry/aabb.h"
#include "core/probe.h"

namespace touchmark::baselines {

/// The reach, or a little more than the distance to the farthest corner of the mesh's box when that is less:
/// the same triangles, as a number that rivals can compute with. Negative and NaN stay as they are.
inline double finite_reach(const Aabb& bounds, const Vec3& center, double reach) noexcept {
  const Vec3 farthest = (bounds.min - center).cwiseAbs().cwiseMax((bounds.max - center).cwiseAbs());
  constexpr double roundings = 1 + 8 * std::numeric_limits<double>::epsilon();
  const double everything = roundings * farthest.norm();
  return reach < everything ? reach : everything;
}

/// Rivals are only asked about places they can subtract and square.
inline bool answerable(const Vec3& center, double reach) noexcept {
  constexpr double largest = 1e150;
  return reach >= 0 && center.cwiseAbs().maxCoeff() < largest && center.allFinite();
}

}  // namespace touchmark::baselines
