/// Small meshes and seeded probes that the tests of all rivals share.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "bench/support/random.h"
#include "core/triangle_mesh.h"

namespace touchmark::baselines {

using bench::support::Random;

/// The unit square in z = 0, as two triangles.
inline TriangleMesh square() {
  return TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
}

/// A bumpy height field over [-1, 1]^2 with cells x cells quads: well-shaped triangles, many ties at edges.
inline TriangleMesh bumps(std::uint32_t cells) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const double x = 2.0 * i / cells - 1, y = 2.0 * j / cells - 1;
      vertices.emplace_back(x, y, 0.2 * std::sin(5 * x) * std::cos(4 * y));
    }
  }
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t v = j * (cells + 1) + i;
      triangles.push_back({v, v + 1, v + cells + 1});
      triangles.push_back({v + 1, v + cells + 2, v + cells + 1});
    }
  }
  return TriangleMesh(std::move(vertices), std::move(triangles));
}

/// Random triangles about random places in [-1, 1]^3; every fifth is a sliver.
inline TriangleMesh soup(std::uint32_t triangles, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> corners;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Vec3 place = random.point(), along = 0.2 * random.point();
    const double width = i % 5 == 0 ? 1e-7 : 0.2;
    vertices.push_back(place);
    vertices.push_back(place + along);
    vertices.push_back(place + random.unit() * along + width * random.point());
    corners.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return TriangleMesh(std::move(vertices), std::move(corners));
}

/// The same triangles, one corner of the box pushed in and everything shifted a little.
inline TriangleMesh moved(const TriangleMesh& mesh) {
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (Vec3& v : vertices) {
    v += Vec3(0.01, 0, 0.02);
    if (v.x() > 0.3 && v.y() > 0.3) v.z() += 0.4;
  }
  return {std::move(vertices),
          {mesh.triangles().begin(), mesh.triangles().end()},
          {mesh.ids().begin(), mesh.ids().end()}};
}

}  // namespace touchmark::baselines
