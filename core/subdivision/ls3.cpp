#include "core/subdivision/ls3.h"

#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "core/subdivision/algebraic_sphere.h"
#include "core/subdivision/loop.h"

namespace touchmark {
namespace {

Vec3 unit_or_zero(const Vec3& v) {
  // By the largest component first, so that squares neither vanish nor overflow.
  const double largest = v.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return Vec3::Zero();
  return (v / largest).normalized();
}

}  // namespace

std::vector<Vec3> angle_weighted_normals(const IndexedTriangles& mesh) {
  std::vector<Vec3> normals(mesh.positions.size(), Vec3::Zero());
  for (const auto& corners : mesh.faces) {
    const Vec3& a = mesh.positions[corners[0]];
    const Vec3& b = mesh.positions[corners[1]];
    const Vec3& c = mesh.positions[corners[2]];
    const Vec3 normal = unit_or_zero((b - a).cross(c - a));
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& here = mesh.positions[corners[i]];
      const Vec3 u = unit_or_zero(mesh.positions[corners[(i + 1) % 3]] - here);
      const Vec3 v = unit_or_zero(mesh.positions[corners[(i + 2) % 3]] - here);
      normals[corners[i]] += std::atan2(u.cross(v).norm(), u.dot(v)) * normal;
    }
  }
  return normals;
}

void normalize(std::vector<Vec3>& normals) {
  for (Vec3& normal : normals) normal = unit_or_zero(normal);
}

PointsAndNormals ls3_points(const TriangleSurface& surface, std::span<const Vec3> positions,
                            std::span<const Vec3> normals, std::span<const std::uint32_t> edges) {
  PointsAndNormals result;
  result.points.reserve(positions.size() + edges.size());
  result.normals.reserve(positions.size() + edges.size());
  AlgebraicSphereFit fit;
  std::vector<Weight> mask;
  const auto put = [&](bool on_sphere) {
    fit.clear();
    for (const auto& [vertex, weight] : mask) fit.add(positions[vertex], normals[vertex], weight);
    const auto [point, gradient] = fit.mean_on_sphere();
    result.points.push_back(on_sphere ? point : weighted_mean(mask, positions));
    result.normals.push_back(unit_or_zero(gradient));
  };
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    loop_vertex_mask(surface, v, mask);
    put(surface.location(v) != TriangleSurface::Location::corner);
  }
  for (const std::uint32_t edge : edges) {
    loop_edge_mask(surface, edge, mask);
    put(surface.location_of_edge(edge) != TriangleSurface::Location::corner);
  }
  return result;
}

}  // namespace touchmark
