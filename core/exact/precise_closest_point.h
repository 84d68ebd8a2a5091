/// The nearest point of a triangle in 106 bits: what is asked between the kernel of point_triangle.h, which
/// rounds to 53, and the whole numbers of distance_predicates.h, which take ten times as long.
#pragma once

#include <array>
#include <compare>
#include <optional>

#include "core/exact/distance_predicates.h"
#include "core/probe.h"

namespace touchmark {

struct PreciseClosestPoint {
  ClosestPoint closest;
  /// The ends of the edge it lies on, the corner twice where it is one; nothing over the face.
  std::optional<std::array<Vec3, 2>> feature;
  bool inside = false;  ///< over the face, and surely off its border
};

/// Nothing where 106 bits do not tell whether face or border is nearest, or which edge, or where the error of
/// the distance might exceed 2^-60 of the largest coordinate difference between the point and the corners:
/// beside the borders between two of them, for needles and what has no area, and where that difference is
/// below 2^-132, above 2^232 or no number. Over a face across a coordinate axis, its border included, the
/// distance is exact. A call takes about twenty times as long as the kernel.
std::optional<PreciseClosestPoint> precise_closest_point(const TriangleCorners& triangle,
                                                         const Vec3& point) noexcept;

/// Is it on one corner, or one edge, that both have? Then the distances are equal.
bool on_same_feature(const PreciseClosestPoint& a, const PreciseClosestPoint& b) noexcept;

/// How the distances to two triangles compare whose feet both are inside, by how far these are off the edge
/// that the triangles share; unordered where there is none, or that does not tell.
std::partial_ordering compare_inside(const TriangleCorners& a, const TriangleCorners& b,
                                     const Vec3& point) noexcept;

/// `a` is inside its triangle, `b` on an edge or a corner that this triangle has as well: then `a` is nearer.
bool is_nearer_inside(const PreciseClosestPoint& a, const TriangleCorners& triangle_of_a,
                      const PreciseClosestPoint& b) noexcept;

}  // namespace touchmark
