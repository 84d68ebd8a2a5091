/// When a triangle whose corners go straight first meets a point that goes straight: exact.
/// docs/exactness.md, E34.
#pragma once

#include <optional>

#include "core/exact/feature.h"
#include "core/probe.h"

namespace touchmark {

/// Corners go from `start` to `end` while the point goes from `from` to `to`, all at an even pace. Returns
/// the part of the way at which the triangle first holds the point, rounded down by less than 2^-50, or
/// nothing. Finite coordinates. Where they need more than 160 bits together, what takes more than 4,096
/// halvings of the way to decide counts as met.
std::optional<double> first_meeting(const TriangleCorners& start, const TriangleCorners& end,
                                    const Vec3& from, const Vec3& to) noexcept;

}  // namespace touchmark
