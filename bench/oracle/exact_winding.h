/// How often a closed surface winds round a point: the truth about inside and outside. By a ray in a
/// direction of whole numbers that is drawn again whenever the ray meets an edge; every sign in question is
/// decided in integers. Shares nothing with core/sign.
#pragma once

#include <optional>
#include <span>

#include "bench/oracle/triangle.h"

namespace touchmark::bench {

/// Every edge must have as many triangles one way as the other; nothing where the point is on a triangle.
/// Finite coordinates. Looks at every triangle.
std::optional<int> winding_exactly(const Vec3& point, std::span<const Triangle> triangles);

}  // namespace touchmark::bench
