/// A mesh while it is put together of parts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/triangle_mesh.h"

namespace touchmark::bench::meshes {

using Corners = TriangleMesh::Corners;

struct Surface {
  std::vector<Vec3> vertices;
  std::vector<Corners> triangles;

  std::uint32_t add(const Vec3& vertex) {
    vertices.push_back(vertex);
    return static_cast<std::uint32_t>(vertices.size() - 1);
  }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
  /// Adds a copy of `mesh`, scaled about the origin and then moved.
  void part(const TriangleMesh& mesh, double scale, const Vec3& to) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& vertex : mesh.vertices()) vertices.emplace_back(scale * vertex + to);
    for (const Corners& corners : mesh.triangles())
      triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
  }
  TriangleMesh mesh() && { return {std::move(vertices), std::move(triangles)}; }
};

/// Adds a closed box of 12 triangles.
void add_box(Surface& surface, const Vec3& low, const Vec3& high);

/// Adds a grid of (across + 1) x (along + 1) vertices, two triangles a square: place(u, v) with u and v from
/// 0 to 1.
template <class Place>
void add_patch(Surface& surface, std::uint32_t across, std::uint32_t along, Place place) {
  const auto first = static_cast<std::uint32_t>(surface.vertices.size());
  for (std::uint32_t i = 0; i <= across; ++i)
    for (std::uint32_t j = 0; j <= along; ++j)
      surface.add(place(static_cast<double>(i) / across, static_cast<double>(j) / along));
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return first + i * (along + 1) + j; };
  for (std::uint32_t i = 0; i < across; ++i)
    for (std::uint32_t j = 0; j < along; ++j)
      surface.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
}

/// Adds a closed tube of so many sides (at least 3) round the line through two or more points, its ends fans:
/// 2 * sides * points triangles.
void add_tube(Surface& surface, const std::vector<Vec3>& line, double radius, std::uint32_t sides);

/// Returns how many triangles add_tube adds.
inline std::uint64_t tube_triangles(std::uint64_t points, std::uint64_t sides) { return 2 * sides * points; }

}  // namespace touchmark::bench::meshes
