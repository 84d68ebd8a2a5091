/// Small meshes for the grid's tests, made from numbers alone.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "bench/support/random.h"
#include "core/triangle_mesh.h"

namespace touchmark::testing {

using bench::support::Random;

inline TriangleMesh moved(const TriangleMesh& mesh, double scale, const Vec3& shift) {
  std::vector<Vec3> vertices;
  for (const Vec3& v : mesh.vertices()) vertices.push_back(scale * v + shift);
  return {vertices, {mesh.triangles().begin(), mesh.triangles().end()}};
}

/// 20 * 4^levels triangles on the unit sphere.
inline TriangleMesh icosphere(int levels) {
  const double g = std::numbers::phi;
  std::vector<Vec3> v = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                         {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Vec3& p : v) p.normalize();
  std::vector<TriangleMesh::Corners> t = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                          {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                          {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                          {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, added] = middles.try_emplace({std::min(a, b), std::max(a, b)}, v.size());
      if (added) v.push_back(Vec3(v[a] + v[b]).normalized());
      return at->second;
    };
    std::vector<TriangleMesh::Corners> finer;
    for (const auto& [a, b, c] : t) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    t = std::move(finer);
  }
  return {v, t};
}

/// Triangles of the given size anywhere in the cube [-1, 1]^3.
inline TriangleMesh soup(std::uint32_t count, double size, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> v;
  std::vector<TriangleMesh::Corners> t;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 a = random.point(1);
    for (int k = 0; k < 3; ++k) v.push_back(a + random.point(size));
    t.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {v, t};
}

/// A fan of needles around the z axis, a thousand times as long as wide.
inline TriangleMesh sliver_fan(std::uint32_t count) {
  std::vector<Vec3> v = {{0, 0, 0.1}};
  std::vector<TriangleMesh::Corners> t;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    v.emplace_back(std::cos(angle), std::sin(angle), 0.05 * std::sin(7 * angle));
    t.push_back({0, i + 1, (i + 1) % count + 1});
  }
  return {v, t};
}

/// A square of n by n cells in the plane z = 0: a box without height, with borders where cells have theirs.
inline TriangleMesh plate(std::uint32_t n) {
  std::vector<Vec3> v;
  std::vector<TriangleMesh::Corners> t;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) v.emplace_back(double(x) / n, double(y) / n, 0);
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      t.push_back({a, b, c});
      t.push_back({b, d, c});
    }
  }
  return {v, t};
}

/// One triangle that spans everything among many small ones.
inline TriangleMesh one_spans_all() {
  const TriangleMesh small = soup(300, 0.02, 77);
  std::vector<Vec3> v(small.vertices().begin(), small.vertices().end());
  std::vector<TriangleMesh::Corners> t(small.triangles().begin(), small.triangles().end());
  const auto first = static_cast<std::uint32_t>(v.size());
  v.insert(v.end(), {Vec3(-3, -3, -3), Vec3(3, -3, 3), Vec3(0, 3, 0)});
  t.push_back({first, first + 1, first + 2});
  return {v, t};
}

/// Points, segments, doubled triangles and slivers next to a few ordinary triangles.
inline TriangleMesh degenerate() {
  std::vector<Vec3> v = {{0, 0, 0},         {1, 0, 0},     {0, 1, 0}, {0.5, 0, 0},
                         {0.25, 0.25, 0.5}, {1, 1e-12, 0}, {1, 1, 1}};
  return {
      v, {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}, {0, 3, 1}, {4, 4, 4}, {0, 1, 5}, {6, 6, 2}, {1, 6, 4}, {5, 5, 5}}};
}

struct NamedMesh {
  const char* name;
  TriangleMesh mesh;
};

/// Small enough that brute force answers thousands of probes.
inline std::vector<NamedMesh> nasty_meshes() {
  std::vector<NamedMesh> meshes;
  const auto add = [&](const char* name, TriangleMesh mesh) { meshes.push_back({name, std::move(mesh)}); };
  add("icosphere", icosphere(3));
  add("soup", soup(700, 0.15, 5));
  add("fine soup", soup(700, 0.01, 6));
  add("sliver fan", sliver_fan(400));
  add("plate", plate(16));
  add("one triangle spans all", one_spans_all());
  add("degenerate", degenerate());
  add("single triangle", TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  add("a segment", TriangleMesh({{0, 0, 0}, {1, 2, 3}}, {{0, 1, 1}, {0, 0, 1}}));
  add("a point", TriangleMesh({{1, 2, 3}}, {{0, 0, 0}, {0, 0, 0}}));
  add("far away", moved(icosphere(2), 1, {1e6, -1e6, 1e6}));
  add("tiny", moved(icosphere(2), 1e-6, {0, 0, 0}));
  add("huge", moved(soup(300, 0.1, 7), 1e6, {0, 0, 0}));
  add("hugest", moved(soup(50, 0.3, 8), 1e140, {0, 0, 0}));
  add("tiniest", moved(soup(50, 0.3, 9), 1e-140, {0, 0, 0}));
  add("long and thin", [] {
    const TriangleMesh mesh = soup(500, 0.05, 10);
    std::vector<Vec3> v;
    for (const Vec3& p : mesh.vertices()) v.emplace_back(1e5 * p.x(), p.y(), 1e-3 * p.z());
    return TriangleMesh(v, {mesh.triangles().begin(), mesh.triangles().end()});
  }());
  return meshes;
}

}  // namespace touchmark::testing
