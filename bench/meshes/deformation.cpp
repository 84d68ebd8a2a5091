#include "bench/meshes/deformation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "bench/support/random.h"

namespace touchmark::bench::meshes {
namespace {

constexpr double depth_of_radius = 0.25;
constexpr double amplitude_of_diagonal = 0.01, waves_in_diagonal = 2;

/// The `count` vertices nearest to one of them, the farthest last.
std::vector<std::uint32_t> patch(const TriangleMesh& mesh, std::size_t count, support::Random& random) {
  const Vec3 middle = mesh.vertices()[mesh.triangles()[random.below(mesh.size())][0]];
  std::vector<double> squared;
  for (const Vec3& v : mesh.vertices()) squared.push_back((v - middle).squaredNorm());
  std::vector<std::uint32_t> nearest(squared.size());
  std::iota(nearest.begin(), nearest.end(), 0U);
  const auto last = nearest.begin() + static_cast<std::ptrdiff_t>(count) - 1;
  std::nth_element(nearest.begin(), last, nearest.end(), [&](std::uint32_t a, std::uint32_t b) {
    return squared[a] < squared[b] || (squared[a] == squared[b] && a < b);
  });
  nearest.resize(count);
  return nearest;
}

/// Against the sum of the normals of the triangles there, weighted by area; down where they cancel.
Vec3 inwards(const TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices) {
  std::vector<bool> in_patch(mesh.vertices().size(), false);
  for (const std::uint32_t v : vertices) in_patch[v] = true;
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    if (!in_patch[mesh.triangles()[i][0]]) continue;
    sum += (mesh.corner(i, 1) - mesh.corner(i, 0)).cross(mesh.corner(i, 2) - mesh.corner(i, 0));
  }
  const double length = sum.norm();
  return length > 0 ? Vec3(-sum / length) : Vec3(-Vec3::UnitZ());
}

void dent(const TriangleMesh& mesh, double share, support::Random& random, std::vector<Vec3>& vertices) {
  const double wanted = std::round(share * static_cast<double>(vertices.size()));
  const std::vector<std::uint32_t> moved =
      patch(mesh, std::clamp<std::size_t>(static_cast<std::size_t>(wanted), 1, vertices.size()), random);
  Aabb box;
  for (const std::uint32_t v : moved) box.extend(vertices[v]);
  const Vec3 middle = box.center(), direction = inwards(mesh, moved);
  double radius = 0;
  for (const std::uint32_t v : moved) radius = std::max(radius, (vertices[v] - middle).norm());
  // A patch of one vertex, or of many at one place, has no radius of its own.
  if (!(radius > 0)) radius = 0.01 * mesh.diagonal();
  for (const std::uint32_t v : moved) {
    // A little beyond the patch's border, so that every one of it moves.
    const double out = (vertices[v] - middle).norm() / (1.05 * radius);
    vertices[v] += depth_of_radius * radius * (1 - out * out) * (1 - out * out) * direction;
  }
}

/// -1 to 1 and back for each whole number, smooth, and the same bits everywhere, which a sine is not.
double wave(double t) {
  const double s = t - std::floor(t);
  return 32 * s * s * (1 - s) * (1 - s) - 1;
}

void ripple(const TriangleMesh& mesh, support::Random& random, std::vector<Vec3>& vertices) {
  const double diagonal = mesh.diagonal();
  if (!(diagonal > 0)) return;
  const Vec3 along = random.direction(), direction = random.direction();
  const Vec3 middle = mesh.bounds().center();
  for (Vec3& v : vertices) {
    const double t = waves_in_diagonal * along.dot(v - middle) / diagonal;
    v += amplitude_of_diagonal * diagonal * wave(t) * direction;
  }
}

}  // namespace

TriangleMesh deformed(const TriangleMesh& mesh, const Deformation& deformation) {
  support::Random random(deformation.seed);
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  if (deformation.share < 1) {
    dent(mesh, deformation.share, random, vertices);
  } else {
    ripple(mesh, random, vertices);
  }
  return {std::move(vertices),
          {mesh.triangles().begin(), mesh.triangles().end()},
          {mesh.ids().begin(), mesh.ids().end()}};
}

std::size_t moved_vertices(const TriangleMesh& before, const TriangleMesh& after) {
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.vertices().size(); ++i) {
    const bool same =
        std::memcmp(before.vertices()[i].data(), after.vertices()[i].data(), 3 * sizeof(double)) == 0;
    moved += same ? 0 : 1;
  }
  return moved;
}

}  // namespace touchmark::bench::meshes
