/// Point-triangle distances of the numbers as they are stored: nothing rounds until the result is known.
///
/// Every decision is a comparison of whole numbers (big_integer.h), so any finite doubles will do, denormal
/// and huge ones alike, and needles, caps and triangles without area. No memory is taken. A call takes
/// hundreds of times as long as the kernel of point_triangle.h, more where the numbers span the whole range
/// of double: it is for what the kernel leaves open.
#pragma once

#include <array>
#include <compare>
#include <optional>

#include "core/exact/double_double.h"
#include "core/exact/feature.h"
#include "core/probe.h"

namespace touchmark {

/// Is the distance at most the radius? Exact. False when a coordinate is not finite or the radius not at
/// least 0; the radius may be infinite.
bool within_exactly(const TriangleCorners& triangle, const Vec3& point, double radius) noexcept;

/// Returns whether a bare point meets the triangle on the path from `from` to `to`, by the sides of planes
/// and lines that these points are on: exact, and doubles decide most of them. Nothing where the triangle has
/// no area. Finite coordinates.
std::optional<bool> meets_by_sides(const TriangleCorners& triangle, const Vec3& from,
                                   const Vec3& to) noexcept;

/// Does the part of the path from `from` to `to` up to and with `fraction` come within the radius of the
/// triangle? Exact, for a fraction in [0, 1] that is a multiple of 2^-53; false when a coordinate is not
/// finite or the radius not at least 0.
bool path_within_exactly(const TriangleCorners& triangle, const Vec3& from, const Vec3& to, double fraction,
                         double radius) noexcept;

/// Returns where a bare point first meets the triangle on a path from `from` to `to` that meets it: a
/// fraction below by less than 2^-51 or, at the start, 0. Finite coordinates.
double first_meeting_exactly(const TriangleCorners& triangle, const Vec3& from, const Vec3& to) noexcept;

/// How the distances to two triangles compare. Exact, for finite coordinates.
std::strong_ordering compare_exactly(const TriangleCorners& a, const TriangleCorners& b,
                                     const Vec3& point) noexcept;

/// The nearest point of a triangle to a point.
struct ClosestPoint {
  DoubleDouble distance;          ///< infinite beyond all doubles
  double error = 0;               ///< bound of the distance's; infinite where none is known
  Vec3 offset = Vec3::Zero();     ///< from the foot to the point
  Vec3 direction = Vec3::Zero();  ///< unit vector along the offset; zero where the distance is 0
};

/// How the distances compare; unordered where their errors do not tell.
std::partial_ordering compare(const ClosestPoint& a, const ClosestPoint& b) noexcept;

/// Rounded at the end: the distance within 2^-98 of it where both halves of it are normal, each coordinate of
/// the offset within one ulp, the direction zero only where the distance is exactly 0. Finite coordinates.
ClosestPoint closest_point_exactly(const TriangleCorners& triangle, const Vec3& point) noexcept;

/// The unit normal, counter-clockwise, each coordinate within a few ulp; zero when the corners are exactly
/// collinear. Finite coordinates.
Vec3 normal_exactly(const TriangleCorners& triangle) noexcept;

}  // namespace touchmark
