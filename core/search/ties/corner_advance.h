/// Quick and certain answers about triangles that are as near but for rounding: bounds by a few products in
/// 106 bits, at a tenth of what a nearest point in 106 bits takes (precise_closest_point.h).
#pragma once

#include <compare>
#include <limits>
#include <optional>

#include "core/exact/distance_predicates.h"
#include "core/exact/double_double_vector.h"
#include "core/probe.h"

namespace touchmark {

/// Compares a triangle with others that have one corner with it, by how much nearer than that corner they
/// come: docs/exactness.md, E6, step 4. Distances that agree to 2^-106, as over the hub of an oblique wheel,
/// so have very different s.
class BesideCorner {
 public:
  /// The corner is the one of this triangle that is nearest to the point.
  BesideCorner(const TriangleCorners& nearest, const Vec3& point) noexcept;

  /// How the triangle's distance compares with that of the first; unordered where this does not tell.
  std::partial_ordering compare(const TriangleCorners& triangle) const noexcept;

 private:
  /// Bounds of s: the triangle comes as near as `lower` says, and no nearer than `upper` says.
  struct Advance {
    double lower = 0, upper = std::numeric_limits<double>::infinity();
  };
  Advance advance(const TriangleCorners& triangle, std::size_t corner) const noexcept;

  Vec3 corner_;
  double_double::Vector offset_;  ///< from the corner to the point, exact
  double length_;                 ///< length of the offset, rounded
  Advance own_;
};

}  // namespace touchmark
