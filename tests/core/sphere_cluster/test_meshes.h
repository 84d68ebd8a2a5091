/// Small meshes for the sphere-cluster tests, the well-behaved and the nasty, and probes near them.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "bench/support/random.h"
#include "core/triangle_mesh.h"

namespace touchmark::test {

using bench::support::Random;

/// A sphere of radius 1 in rings, its vertices moved by up to `noise`; closed, with collapsed quads at the
/// poles (degenerate triangles).
inline TriangleMesh bumpy_sphere(std::uint32_t rings, double noise, std::uint64_t seed) {
  Random random(seed);
  const std::uint32_t around = 2 * rings;
  std::vector<Vec3> vertices;
  for (std::uint32_t i = 0; i <= rings; ++i)
    for (std::uint32_t k = 0; k < around; ++k) {
      const double polar = std::numbers::pi * i / rings, turn = 2 * std::numbers::pi * k / around;
      const double radius = i == 0 || i == rings ? 1 : 1 + random.between(-noise, noise);
      vertices.push_back(
          radius * Vec3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)));
    }
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t next = (k + 1) % around;
      const std::uint32_t a = i * around + k, b = i * around + next, c = a + around, d = b + around;
      triangles.push_back({a, c, b});
      triangles.push_back({b, c, d});
    }
  return {std::move(vertices), std::move(triangles)};
}

/// Triangles with independent corners, each of about `size`.
inline TriangleMesh soup(std::size_t count, double size, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 center = random.point(1);
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (int k = 0; k < 3; ++k) vertices.push_back(center + random.point(size));
    triangles.push_back({first, first + 1, first + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

/// A flat grid of n x n quads on z = 0: every edge and vertex is a tie.
inline TriangleMesh plate(std::uint32_t n) {
  std::vector<Vec3> vertices;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t k = 0; k <= n; ++k) vertices.emplace_back(2.0 * i / n - 1, 2.0 * k / n - 1, 0);
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t a = i * (n + 1) + k, b = a + 1, c = a + n + 1, d = c + 1;
      triangles.push_back({a, c, b});
      triangles.push_back({b, c, d});
    }
  return {std::move(vertices), std::move(triangles)};
}

/// Needles from one point and slivers along one edge.
inline TriangleMesh slivers(std::uint32_t count) {
  std::vector<Vec3> vertices = {{0, 0, 0}, {1, 0, 0}};
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double turn = 2 * std::numbers::pi * i / count;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.emplace_back(std::cos(turn), std::sin(turn), 0.3);
    vertices.emplace_back(std::cos(turn + 1e-7), std::sin(turn + 1e-7), 0.3);
    vertices.emplace_back(0.5, 1e-6 * std::cos(turn), 1e-6 * std::sin(turn));
    triangles.push_back({0, first, first + 1});
    triangles.push_back({0, 1, first + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

/// The same triangle again and again, between two that differ.
inline TriangleMesh repeated(std::size_t count) {
  const std::vector<Vec3> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
  std::vector<TriangleMesh::Corners> triangles(count, {0, 1, 2});
  triangles.front() = triangles.back() = {3, 4, 5};
  return {vertices, std::move(triangles)};
}

/// Two triangles a million wide among small ones.
inline TriangleMesh huge_among_tiny(std::uint64_t seed) {
  const TriangleMesh tiny = soup(500, 0.02, seed);
  std::vector<Vec3> vertices(tiny.vertices().begin(), tiny.vertices().end());
  std::vector<TriangleMesh::Corners> triangles(tiny.triangles().begin(), tiny.triangles().end());
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), {{-1e6, -1e6, 0.1}, {1e6, -1e6, 0.1}, {0, 1e6, 0.3}, {1e6, 1e6, 1e6}});
  triangles.insert(triangles.begin() + 250, {first, first + 1, first + 2});
  triangles.push_back({first, first + 1, first + 3});
  return {std::move(vertices), std::move(triangles)};
}

/// Points and segments only.
inline TriangleMesh degenerate(std::size_t count, std::uint64_t seed) {
  const TriangleMesh base = soup(count, 0.2, seed);
  std::vector<TriangleMesh::Corners> triangles(base.triangles().begin(), base.triangles().end());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    triangles[i][2] = triangles[i][0];
    if (i % 2 == 0) triangles[i][1] = triangles[i][0];
  }
  return {{base.vertices().begin(), base.vertices().end()}, std::move(triangles)};
}

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
  double size;  ///< probes are drawn within this of `center`
  Vec3 center = Vec3::Zero();
};

inline std::vector<NamedMesh> test_meshes() {
  std::vector<NamedMesh> meshes;
  meshes.push_back({"bumpy sphere", bumpy_sphere(16, 0.05, 1), 1.3});
  meshes.push_back({"soup", soup(600, 0.3, 2), 1.3});
  meshes.push_back({"plate", plate(16), 1.2});
  meshes.push_back({"slivers", slivers(150), 1.2});
  meshes.push_back({"repeated", repeated(300), 2});
  meshes.push_back({"huge among tiny", huge_among_tiny(3), 1.2});
  meshes.push_back({"degenerate", degenerate(300, 4), 1.2});
  meshes.push_back({"one triangle", soup(1, 1, 5), 2});
  meshes.push_back({"one point", TriangleMesh({{1, 2, 3}}, {{0, 0, 0}}), 4});
  const Vec3 far = Vec3::Constant(1e6);
  meshes.push_back({"far offset", bumpy_sphere(12, 0.05, 6).transformed(1, far), 1.3, far});
  meshes.push_back({"micrometres", bumpy_sphere(12, 0.05, 7).transformed(1e-6, Vec3::Zero()), 1.3e-6});
  meshes.push_back({"megametres", bumpy_sphere(12, 0.05, 8).transformed(1e6, Vec3::Zero()), 1.3e6});
  meshes.push_back({"vanishing", soup(100, 0.3, 9).transformed(1e-160, Vec3::Zero()), 1.3e-160});
  meshes.push_back({"overflowing", soup(100, 0.3, 10).transformed(1e160, Vec3::Zero()), 1.3e160});
  return meshes;
}

/// A point near the mesh: in the box around it, near a triangle, or on a vertex or an edge's middle.
inline Vec3 random_point(const NamedMesh& named, Random& random) {
  const TriangleMesh& mesh = named.mesh;
  const std::size_t triangle = random.below(mesh.size());
  const Vec3 &a = mesh.corner(triangle, 0), &b = mesh.corner(triangle, 1), &c = mesh.corner(triangle, 2);
  switch (random.below(5)) {
    case 0:
      return a;
    case 1:
      return 0.5 * (a + b);
    case 2: {
      const double u = random.between(0, 1), v = random.between(0, 1 - u);
      return a + u * (b - a) + v * (c - a) + random.point(0.02 * named.size);
    }
    default:
      return named.center + random.point(named.size);
  }
}

}  // namespace touchmark::test
