/// Distances to the images of triangles under poses, of the numbers as they are stored: nothing rounds.
///
/// A corner's image is rotation * x + translation, a polynomial of degree 2 in stored doubles, so that the
/// decisions are those of core/exact/exact_closest_point.h at twice the degree. No memory is taken. A call
/// takes ten microseconds or more, for what doubles leave open; within_by_sides takes less, and may not tell.
#pragma once

#include <compare>
#include <optional>

#include "core/exact/distance_predicates.h"
#include "core/exact/feature.h"
#include "core/probe.h"
#include "core/scene/pose.h"

namespace touchmark {

/// A triangle of a body: its stored corners, and where the body is. The pose outlives it. Of a round body the
/// image is the axis, a point or a segment, and the surface is all that is so far from it.
struct PosedTriangle {
  TriangleCorners corner;
  const Pose* pose = nullptr;
  double radius = 0;  ///< 0: the image itself is the surface
};

/// Is the distance to the surface at most the radius? Exact. False when a coordinate is not finite or the
/// radius not at least 0; the radius may be infinite.
bool within_exactly(const PosedTriangle& triangle, const Vec3& point, double radius) noexcept;

/// Does the part of the path up to and with `fraction`, a multiple of 2^-53 in [0, 1], come within the radius
/// of the surface? Exact, and false as above.
bool path_within_exactly(const PosedTriangle& triangle, const Vec3& from, const Vec3& to, double fraction,
                         double radius) noexcept;

/// What path_within_exactly says of the whole path where the triangle's own radius is 0, by the sides of the
/// plane and, for a bare point, of the path's line in double-double (docs/exactness.md, E30). Nothing where
/// these leave it open.
std::optional<bool> within_by_sides(const PosedTriangle& triangle, const Vec3& from, const Vec3& to,
                                    double radius) noexcept;

/// Is the point nearer to the axis than the surface is? Exact, for finite numbers.
bool lies_inside(const PosedTriangle& triangle, const Vec3& point) noexcept;

/// How the distances to two surfaces compare. Exact, for finite numbers.
std::strong_ordering compare_exactly(const PosedTriangle& a, const PosedTriangle& b,
                                     const Vec3& point) noexcept;

/// The nearest point of the image, whatever its radius, rounded at the end as
/// core/exact/distance_predicates.h says.
ClosestPoint closest_point_exactly(const PosedTriangle& triangle, const Vec3& point) noexcept;

}  // namespace touchmark
