/// Triangles of a polygon.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/probe.h"

namespace touchmark::mesh_io {

using PolygonTriangle = std::array<std::size_t, 3>;  ///< positions in the list of corners

/// Clips ears in the plane that the polygon faces, so a flat polygon that is not convex keeps its shape. Of
/// one that crosses itself or has no area what is left without an ear becomes a fan. Takes the cube of the
/// number of corners at worst.
std::vector<PolygonTriangle> clipped_ears(const std::vector<Vec3>& vertices,
                                          const std::vector<std::uint32_t>& corners);

/// The fan about the first corner. Empty where a triangle of it would be turned over by more than single
/// precision rounds a coordinate: a convex polygon's fan covers just the polygon, and so does that of any
/// other whose first corner sees all of it. Linear in the number of corners.
std::vector<PolygonTriangle> fan(const std::vector<Vec3>& vertices,
                                 const std::vector<std::uint32_t>& corners);

}  // namespace touchmark::mesh_io
