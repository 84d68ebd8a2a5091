/// What scripts/plot-papers draws pictures from: meshes, spheres and boxes as short CSV files of numbers.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/aabb.h"
#include "core/geometry/smallest_sphere.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::papers {

/// ax,ay,az,bx,by,bz,cx,cy,cz: a line a triangle, in the mesh's order.
std::string triangles_csv(const TriangleMesh& mesh);
/// Returns such a file of these triangles alone.
std::string triangles_csv(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles);
/// x,y,z,radius
std::string spheres_csv(std::span<const Sphere> spheres);
/// min_x,min_y,min_z,max_x,max_y,max_z
std::string boxes_csv(std::span<const Aabb> boxes);

}  // namespace touchmark::bench::experiments::papers
