/// What every rival needs before it can be asked: most of them square, add or quantise whatever they get.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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

/// Calls ask(within) -> optional<Contact> for balls that double in size, outwards from the mesh's box, until
/// one finds something, at last for the reach: a ball about everything would make a rival look at every
/// triangle.
template <class Ask>
std::optional<Contact> nearest_by_growing(const Aabb& bounds, const Vec3& center, double reach, Ask ask) {
  const double outside = std::sqrt(bounds.squared_distance(center));
  constexpr int doublings = 7;  // from 1/128 of the box's diagonal to all of it
  double inside = std::ldexp(bounds.diagonal(), -doublings);
  for (int i = 0; i < doublings && outside + inside < reach; ++i, inside *= 2) {
    if (std::optional<Contact> contact = ask(outside + inside)) return contact;
  }
  return ask(reach);
}

}  // namespace touchmark::baselines
