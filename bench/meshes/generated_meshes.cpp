#include "bench/meshes/generated_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "bench/meshes/portable_sincos.h"
#include "bench/meshes/surface_builder.h"

namespace touchmark::bench::meshes {
namespace {

Surface icosahedron() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  Surface surface;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      surface.add(Vec3(0, a, b).normalized());
      surface.add(Vec3(a, b, 0).normalized());
      surface.add(Vec3(b, 0, a).normalized());
    }
  }
  // Its faces are the triples at the least distance from one another.
  const auto neighbours = [&](std::uint32_t i, std::uint32_t j) {
    return (surface.vertices[i] - surface.vertices[j]).squaredNorm() < 1.2;  // edge 1.05, next distance 1.70
  };
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t j = i + 1; j < 12; ++j) {
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (!neighbours(i, j) || !neighbours(j, k) || !neighbours(i, k)) continue;
        const Vec3 &a = surface.vertices[i], &b = surface.vertices[j], &c = surface.vertices[k];
        const bool outwards = (b - a).cross(c - a).dot(a) > 0;
        surface.triangles.push_back(outwards ? Corners{i, j, k} : Corners{i, k, j});
      }
    }
  }
  return surface;
}

/// Each triangle in four, new vertices on the unit sphere.
void split_on_sphere(Surface& surface) {
  struct Edge {
    std::uint64_t ends;  // lower vertex, higher vertex
    std::uint32_t slot;  // 3 * triangle + which
    bool operator<(const Edge& other) const {
      return ends != other.ends ? ends < other.ends : slot < other.slot;
    }
  };
  const std::size_t count = surface.triangles.size();
  std::vector<Edge> edges;
  edges.reserve(3 * count);
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]);
      edges.push_back({(std::uint64_t{low} << 32) | high, static_cast<std::uint32_t>(3 * t + k)});
    }
  }
  std::sort(edges.begin(), edges.end());

  surface.vertices.reserve(surface.vertices.size() + edges.size() / 2);
  std::vector<std::uint32_t> middle(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i == 0 || edges[i].ends != edges[i - 1].ends) {
      const Vec3& low = surface.vertices[edges[i].ends >> 32];
      const Vec3& high = surface.vertices[edges[i].ends & 0xffffffff];
      surface.add((low + high).normalized());
    }
    middle[edges[i].slot] = static_cast<std::uint32_t>(surface.vertices.size() - 1);
  }

  std::vector<Corners> split;
  split.reserve(4 * count);
  for (std::size_t t = 0; t < count; ++t) {
    const auto [a, b, c] = surface.triangles[t];
    const std::uint32_t ab = middle[3 * t], bc = middle[3 * t + 1], ca = middle[3 * t + 2];
    split.push_back({a, ab, ca});
    split.push_back({b, bc, ab});
    split.push_back({c, ca, bc});
    split.push_back({ab, bc, ca});
  }
  surface.triangles = std::move(split);
}

}  // namespace

TriangleMesh icosphere(unsigned levels) {
  Surface surface = icosahedron();
  for (unsigned level = 0; level < levels; ++level) split_on_sphere(surface);
  return std::move(surface).mesh();
}

TriangleMesh torus(std::uint32_t around, std::uint32_t along) {
  constexpr double tube = 0.4;
  Surface surface;
  surface.vertices.reserve(std::size_t{around} * along);
  surface.triangles.reserve(std::size_t{around} * along * 2);
  for (std::uint32_t i = 0; i < around; ++i) {
    const SinCos axis = portable_sincos(static_cast<double>(i) / around);
    for (std::uint32_t j = 0; j < along; ++j) {
      const SinCos ring = portable_sincos(static_cast<double>(j) / along);
      const double from_axis = 1 + tube * ring.cos;
      surface.add({from_axis * axis.cos, from_axis * axis.sin, tube * ring.sin});
    }
  }
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t here = i * along, next = (i + 1) % around * along;
    for (std::uint32_t j = 0; j < along; ++j) {
      const std::uint32_t k = (j + 1) % along;
      surface.quad(here + j, next + j, next + k, here + k);
    }
  }
  return std::move(surface).mesh();
}

TriangleMesh thin_plate() {
  constexpr std::uint32_t cells = 32, row = cells + 1;
  Surface surface;
  for (const double z : {-thin_plate_thickness / 2, thin_plate_thickness / 2})
    for (std::uint32_t i = 0; i < row; ++i)
      for (std::uint32_t j = 0; j < row; ++j)
        surface.add({static_cast<double>(i) / cells - 0.5, static_cast<double>(j) / cells - 0.5, z});
  const auto below = [](std::uint32_t i, std::uint32_t j) { return i * row + j; };
  const auto above = [&](std::uint32_t i, std::uint32_t j) { return row * row + below(i, j); };
  for (std::uint32_t i = 0; i < cells; ++i) {
    for (std::uint32_t j = 0; j < cells; ++j) {
      surface.quad(below(i, j), below(i, j + 1), below(i + 1, j + 1), below(i + 1, j));
      surface.quad(above(i, j), above(i + 1, j), above(i + 1, j + 1), above(i, j + 1));
    }
  }
  for (std::uint32_t k = 0; k < cells; ++k) {
    surface.quad(below(k, 0), below(k + 1, 0), above(k + 1, 0), above(k, 0));
    surface.quad(below(k + 1, cells), below(k, cells), above(k, cells), above(k + 1, cells));
    surface.quad(below(0, k + 1), below(0, k), above(0, k), above(0, k + 1));
    surface.quad(below(cells, k), below(cells, k + 1), above(cells, k + 1), above(cells, k));
  }
  return std::move(surface).mesh();
}

TriangleMesh single_triangle() {
  const double height = std::sqrt(3.0) / 2;
  return {{{-0.5, -height / 3, 0}, {0.5, -height / 3, 0}, {0, 2 * height / 3, 0}}, {{0, 1, 2}}};
}

TriangleMesh cube() {
  Surface surface;
  for (const double z : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double x : {-0.5, 0.5}) surface.add({x, y, z});
  surface.quad(0, 2, 3, 1);
  surface.quad(4, 5, 7, 6);
  surface.quad(0, 1, 5, 4);
  surface.quad(2, 6, 7, 3);
  surface.quad(0, 4, 6, 2);
  surface.quad(1, 3, 7, 5);
  return std::move(surface).mesh();
}

TriangleMesh wedge() {
  constexpr std::uint32_t slices = 16;
  const double half_back = portable_sincos(1.0 / 360).sin /
                           portable_sincos(1.0 / 360).cos;  // one degree either side of the middle
  Surface surface;
  for (std::uint32_t i = 0; i <= slices; ++i) {
    const double y = static_cast<double>(i) / slices - 0.5;
    surface.add({-0.5, y, 0});
    surface.add({0.5, y, -half_back});
    surface.add({0.5, y, half_back});
  }
  for (std::uint32_t i = 0; i < slices; ++i) {
    const std::uint32_t a = 3 * i, b = a + 3;
    surface.quad(a, b, b + 1, a + 1);
    surface.quad(a + 1, b + 1, b + 2, a + 2);
    surface.quad(a + 2, b + 2, b, a);
  }
  const std::uint32_t end = 3 * slices;
  surface.triangles.push_back({0, 1, 2});
  surface.triangles.push_back({end, end + 2, end + 1});
  return std::move(surface).mesh();
}

}  // namespace touchmark::bench::meshes
