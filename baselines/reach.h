/// What every rival needs before it can be asked: most of them square, add or quantise whatever they get. And
/// what whoever uses one in a loop asks before it: the mesh's box, and the triangle of the last contact.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/aabb.h"
#include "core/probe.h"

namespace touchmark::baselines {

/// checked: a point farther from the mesh's box than the reach is told at once, and the triangle of the
/// session's last contact comes first: it answers `touches`, and bounds `nearest` where the rival's answer
/// cannot depend on that. plain: the rival is asked whatever the point.
enum class Asking { checked, plain };

/// In a session: there was no contact last. In an answer: the library names no triangle, and the judge looks
/// for none.
inline constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

/// Returns the largest absolute coordinate of the box.
inline double largest_coordinate(const Aabb& bounds) noexcept {
  return bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs()).maxCoeff();
}

/// True if the mesh is farther away than the reach along some axis. Rounding keeps the order of numbers, so
/// nothing within the reach is told to be beyond it.
inline bool out_of_reach(const Aabb& bounds, const Vec3& center, double reach) noexcept {
  return (bounds.min - center).cwiseMax(center - bounds.max).maxCoeff() > reach;
}

/// True if the whole way is farther from the mesh than the radius along some axis.
inline bool out_of_reach(const Aabb& bounds, const Sweep& sweep) noexcept {
  const Vec3 before = bounds.min - sweep.from.cwiseMax(sweep.to);
  const Vec3 behind = sweep.from.cwiseMin(sweep.to) - bounds.max;
  return before.cwiseMax(behind).maxCoeff() > sweep.radius;
}

/// The reach, or a little more than the distance to the farthest corner of the mesh's box when that is less:
/// the same triangles, as a number that rivals can compute with. A negative reach stays as it is, and NaN
/// counts as infinite.
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

/// Calls ask(within), which returns an optional contact, for balls that double in size, outwards from the
/// mesh's box, until one finds something, at last for the reach: a ball about everything would make a rival
/// look at every triangle.
template <class Ask>
auto nearest_by_growing(const Aabb& bounds, const Vec3& center, double reach, Ask ask) {
  const double outside = std::sqrt(bounds.squared_distance(center));
  constexpr int doublings = 7;  // from 1/128 of the box's diagonal to all of it
  double inside = std::ldexp(bounds.diagonal(), -doublings);
  for (int i = 0; i < doublings && outside + inside < reach; ++i, inside *= 2)
    if (auto contact = ask(outside + inside)) return contact;
  return ask(reach);
}

}  // namespace touchmark::baselines
