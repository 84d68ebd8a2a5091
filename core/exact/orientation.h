/// On which side of a plane or a line a point is: the exact sign of a determinant of the stored doubles.
/// Doubles decide where their rounding cannot matter, whole numbers (big_integer.h) elsewhere. For finite
/// coordinates of any magnitude; no memory is taken.
#pragma once

#include "core/probe.h"

namespace touchmark {

/// The sign of ((b - a) x (c - a)) . (p - a): 1 where a, b, c run counter-clockwise as p sees them, 0 in
/// their plane.
int side_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) noexcept;

/// Returns the side in the plane of x and y: the sign of (b - a) x (p - a), 1 where p is to the left of a to
/// b.
int side_of_line_xy(const Vec3& a, const Vec3& b, const Vec3& p) noexcept;

}  // namespace touchmark
