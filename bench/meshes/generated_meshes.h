/// Meshes that need no file. Each is the same bits on every machine and with every C library: seeded
/// generators, square roots and plain arithmetic only. Closed ones are oriented outwards and centred at the
/// origin.
#pragma once

#include <cstdint>

#include "core/triangle_mesh.h"

namespace touchmark::bench::meshes {

/// More than any mesh here may have; the memory at hand may set a lower limit.
inline constexpr std::uint64_t max_generated_triangles = 200'000'000;

/// An icosahedron on the unit sphere, every triangle split in four `levels` times: 20 * 4^levels triangles.
TriangleMesh icosphere(unsigned levels);

/// Radius 1 to the middle of the tube, the tube's radius 0.4: 2 * around * along triangles, both at least 3.
TriangleMesh torus(std::uint32_t around, std::uint32_t along);

/// A closed slab 1 x 1 x 0.001, its two faces in 32 x 32 squares: 4,352 triangles.
TriangleMesh thin_plate();
inline constexpr double thin_plate_thickness = 0.001;

/// A cone of 1,000 triangles round its apex, from 0.13 down to 1.3e-10 radians wide.
TriangleMesh sliver_fan();

/// A bumpy unit sphere like a scan: noise of many wavelengths along the radius (at most 0.15 together), and
/// jitter finer than the mesh. Exactly `triangles`, or one less where that is odd: a closed surface has an
/// even number. At least 6.
TriangleMesh noisy_sphere(std::uint64_t triangles);

/// Unconnected triangles anywhere in the unit cube, their sizes from 0.001 to 0.3.
TriangleMesh soup(std::uint64_t triangles);

/// Points, segments and collinear triangles among the good ones of a small sphere.
TriangleMesh degenerate();

/// A small sphere with each triangle three times: as it is, again, and the other way round.
TriangleMesh doubled();

/// Triangles with one short edge: aspect ratio (longest edge over smallest height) from 2 to 1e15.
TriangleMesh needles();

/// Triangles whose apex all but lies on the longest edge: aspect ratio from 1.25 to 1e15.
TriangleMesh caps();

/// One equilateral triangle of edge 1: the smallest mesh.
TriangleMesh single_triangle();

/// Edge 1, 12 triangles.
TriangleMesh cube();

/// A closed blade, 1 long and 1 deep, its edge 2 degrees sharp.
TriangleMesh wedge();

}  // namespace touchmark::bench::meshes
