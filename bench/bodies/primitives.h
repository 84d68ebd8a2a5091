/// Bodies that need no mesh file. Lengths are those of the scene; each lies about the origin of its frame.
#pragma once

#include "bench/bodies/body_scene.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::bodies {

/// What a size may be, so that nothing that is worked out of one leaves the range of double.
inline constexpr double least_size = 1e-30, largest_size = 1e30;

/// A box of 12 triangles, whose corners are at half the size to either side.
TriangleMesh box_of(const Vec3& size);

/// A rectangle of two triangles in the plane z = 0, seen from +z counter-clockwise.
TriangleMesh plane_of(double size_x, double size_y);

/// A closed surface of triangles on a sphere or a capsule, within a hundredth of the radius.
TriangleMesh facets_of(const RoundShape& shape);

}  // namespace touchmark::bench::bodies
