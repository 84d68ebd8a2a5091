/// Does a triangle reach into a box?
#pragma once

#include <array>

#include "core/aabb.h"
#include "core/probe.h"

namespace touchmark {

/// Closed, and never a false no: true for every triangle that has a point in the box, and for one that misses
/// it by less than a rounding of the coordinates' differences. Separating axes: 3 of the box, the face's
/// normal, 9 cross products of edges. Akenine-Moeller, "Fast 3D triangle-box overlap testing" (2001).
bool overlaps(const std::array<Vec3, 3>& corner, const Aabb& box) noexcept;

}  // namespace touchmark
