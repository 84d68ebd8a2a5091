/// Small meshes with known subdivisions, and the methods.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "core/subdivision/subdivision.h"
#include "core/triangle_mesh.h"

namespace touchmark::test {

inline constexpr SubdivisionMethod all_methods[] = {
    SubdivisionMethod::butterfly, SubdivisionMethod::catmull_clark, SubdivisionMethod::catmull_clark_linear,
    SubdivisionMethod::mid_point, SubdivisionMethod::loop,          SubdivisionMethod::ls3};

inline TriangleMesh once(const TriangleMesh& mesh, SubdivisionMethod method,
                         SubdivisionForm form = SubdivisionForm::published) {
  return subdivide(mesh, {.method = method, .levels = 1, .form = form});
}

inline TriangleMesh tetrahedron() {
  return TriangleMesh({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                      {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
}

/// Vertices in the order +x, -x, +y, -y, +z, -z.
inline TriangleMesh octahedron() {
  return TriangleMesh(
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

/// On the unit sphere.
inline TriangleMesh icosahedron() {
  const double g = std::numbers::phi, s = 1 / std::sqrt(1 + g * g);
  const std::vector<Vec3> corners = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                     {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                     {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  std::vector<Vec3> vertices;
  for (const Vec3& v : corners) vertices.push_back(s * v);
  return TriangleMesh(std::move(vertices),
                      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}});
}

/// A parallelogram of n x n vertices with every inner one of valence 6: vertex (i, j), number j * n + i,
/// stands at place(i, j).
template <typename Place>
TriangleMesh grid(std::uint32_t n, Place place) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) vertices.push_back(place(i, j));
  for (std::uint32_t j = 0; j + 1 < n; ++j) {
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      const std::uint32_t v = j * n + i;
      triangles.push_back({v, v + 1, v + n});
      triangles.push_back({v + 1, v + n + 1, v + n});
    }
  }
  return TriangleMesh(std::move(vertices), std::move(triangles));
}

/// Numbers in [-1, 1] that are the same everywhere.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return std::ldexp(static_cast<double>(engine_() >> 11), -52) - 1; }
  Vec3 vector() {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {x, y, z};
  }

 private:
  std::mt19937_64 engine_;
};

inline TriangleMesh shaken(const TriangleMesh& mesh, double by, std::uint64_t seed) {
  Noise noise(seed);
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (Vec3& v : vertices) v += by * noise.vector();
  return {std::move(vertices), {mesh.triangles().begin(), mesh.triangles().end()}};
}

/// A bumpy piece of surface with vertices of valence 3 to 8 inside and 2 to 6 on its boundary, which has two
/// loops.
inline TriangleMesh open_patch() {
  constexpr std::uint32_t n = 7;
  const TriangleMesh flat = grid(n, [](std::uint32_t i, std::uint32_t j) { return Vec3(i, j, 0); });
  std::vector<TriangleMesh::Corners> triangles(flat.triangles().begin(), flat.triangles().end());
  // A hole, two flipped edges, and one triangle cut in three.
  const auto at = [](std::uint32_t i, std::uint32_t j) { return j * n + i; };
  std::erase(triangles, TriangleMesh::Corners{at(3, 3), at(4, 3), at(3, 4)});
  const auto flip = [&](std::uint32_t i, std::uint32_t j) {
    std::erase(triangles, TriangleMesh::Corners{at(i, j), at(i + 1, j), at(i, j + 1)});
    std::erase(triangles, TriangleMesh::Corners{at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
    triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
  };
  flip(1, 1);
  flip(4, 1);
  flip(0, 3);
  std::vector<Vec3> vertices(flat.vertices().begin(), flat.vertices().end());
  std::erase(triangles, TriangleMesh::Corners{at(1, 4), at(2, 4), at(1, 5)});
  const auto extra = static_cast<std::uint32_t>(vertices.size());
  vertices.push_back(Vec3(1.3, 4.3, 0));
  triangles.push_back({at(1, 4), at(2, 4), extra});
  triangles.push_back({at(2, 4), at(1, 5), extra});
  triangles.push_back({at(1, 5), at(1, 4), extra});
  return shaken(TriangleMesh(std::move(vertices), std::move(triangles)), 0.2, 11);
}

/// A closed surface of genus 1, irregular in shape.
inline TriangleMesh shaken_torus(std::uint32_t around, std::uint32_t across, double by) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double ring = 2 + std::cos(v);
      vertices.emplace_back(ring * std::cos(u), ring * std::sin(u), std::sin(v));
      const std::uint32_t a = i * across + j, b = (i + 1) % around * across + j;
      const std::uint32_t c = i * across + (j + 1) % across, d = (i + 1) % around * across + (j + 1) % across;
      triangles.push_back({a, b, c});
      triangles.push_back({b, d, c});
    }
  }
  return shaken(TriangleMesh(std::move(vertices), std::move(triangles)), by, 5);
}

}  // namespace touchmark::test
