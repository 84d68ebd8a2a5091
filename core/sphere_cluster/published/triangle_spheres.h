/// One bounding sphere a triangle, the leaves of Choi & Sung's structure: the centre is the triangle's
/// centroid (not its circumcentre, which lies far outside an obtuse triangle), the radius reaches the
/// farthest corner.
#pragma once

#include <cstddef>
#include <vector>

#include "core/sphere_cluster/sphere_radius.h"
#include "core/triangle_mesh.h"

namespace touchmark {

Vec3 centroid(const TriangleMesh& mesh, std::size_t triangle) noexcept;
std::vector<Vec3> centroids(const TriangleMesh& mesh);

/// The least radius about `center`, rounded up, that holds the triangle.
double radius_around(const TriangleMesh& mesh, std::size_t triangle, const Vec3& center) noexcept;

/// Returns the spheres in the mesh's order. The same bits with any number of threads.
std::vector<Sphere> triangle_spheres(const TriangleMesh& mesh, unsigned threads = 1);

}  // namespace touchmark
