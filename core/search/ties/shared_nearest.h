/// Is the nearest point of two triangles one that they share, for certain, by doubles alone?
///
/// Then they are exactly as far, whatever their computed distances have been rounded to. That is what a point
/// beside an edge of a mesh meets at every step, and nothing more exact needs to be asked for it.
#pragma once

#include <array>

#include "core/geometry/point_triangle.h"
#include "core/probe.h"

namespace touchmark {

/// Returns true if the same corner or edge is surely the nearest feature of both, or they are the same
/// triangle in any order. Returns false over the face and next to the borders between two features. Fourth
/// powers of the differences of coordinates must fit the range of double.
bool surely_share_nearest(const PreparedTriangle& a, const PreparedTriangle& b, const Vec3& point) noexcept;

/// Returns true if the same corner is surely the nearest feature of both, at less cost: `offset`, from a's
/// nearest point to `point` as computed, tells which of a's corners it may be. Fourth powers must fit, too.
bool surely_share_corner(const PreparedTriangle& a, const PreparedTriangle& b, const Vec3& point,
                         const Vec3& offset) noexcept;

/// Returns true if both have the same corners, in any order: they are as far from everywhere.
bool have_same_corners(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) noexcept;

}  // namespace touchmark
