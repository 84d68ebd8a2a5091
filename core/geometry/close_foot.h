/// The nearest point of a triangle in 106 bits: what is asked between the kernel of point_triangle.h, which
/// rounds to 53, and the whole numbers of exact_decision.h, which take ten times as long.
#pragma once

#include <array>
#include <optional>

#include "core/geometry/exact_decision.h"
#include "core/probe.h"

namespace touchmark {

struct CloseFoot {
  Foot foot;
  /// The ends of the edge it lies on, the corner twice where it is one; nothing over the face.
  std::optional<std::array<Vec3, 2>> feature;
};

/// Nothing where 106 bits do not tell which corner, edge or face is nearest, or where the error of the
/// distance might exceed 2^-60 of the largest coordinate difference between the point and the corners: beside
/// the borders between two of them, for needles and what has no area, and where that difference is below
/// 2^-132, above 2^232 or no number. Over a face across a coordinate axis, its border included, the distance
/// is exact. A call takes about twenty times as long as the kernel.
std::optional<CloseFoot> close_foot(const TriangleCorners& triangle, const Vec3& point) noexcept;

/// Is it on one corner, or one edge, that both have? Then the distances are equal.
bool on_same_feature(const CloseFoot& a, const CloseFoot& b) noexcept;

}  // namespace touchmark
