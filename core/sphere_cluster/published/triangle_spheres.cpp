#include "core/sphere_cluster/published/triangle_spheres.h"

#include <algorithm>

#include "core/search/threads/parallel.h"

namespace touchmark {

Vec3 centroid(const TriangleMesh& mesh, std::size_t triangle) noexcept {
  // By differences, so that a far offset costs nothing and equal corners give themselves.
  const Vec3& a = mesh.corner(triangle, 0);
  return a + ((mesh.corner(triangle, 1) - a) + (mesh.corner(triangle, 2) - a)) / 3;
}

std::vector<Vec3> centroids(const TriangleMesh& mesh) {
  std::vector<Vec3> all;
  all.reserve(mesh.size());
  for (std::size_t i = 0; i < mesh.size(); ++i) all.push_back(centroid(mesh, i));
  return all;
}

double radius_around(const TriangleMesh& mesh, std::size_t triangle, const Vec3& center) noexcept {
  double radius = 0;
  for (int k = 0; k < 3; ++k) radius = std::max(radius, radius_to(center, mesh.corner(triangle, k)));
  return radius;
}

std::vector<Sphere> triangle_spheres(const TriangleMesh& mesh, unsigned threads) {
  constexpr std::size_t triangles_a_piece = 4096;
  std::vector<Sphere> spheres(mesh.size());
  in_ranges(mesh.size(), triangles_a_piece, threads, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const Vec3 center = centroid(mesh, i);
      spheres[i] = {center, radius_around(mesh, i, center)};
    }
  });
  return spheres;
}

}  // namespace touchmark
