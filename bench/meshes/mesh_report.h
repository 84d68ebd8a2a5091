/// What a user wants to know of a mesh before probing it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/aabb.h"
#include "core/sign/side_finder.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::meshes {

/// Lengths in mesh units. Edges are those between distinct positions: vertices at one place count as one,
/// whatever the file calls them.
struct MeshReport {
  std::size_t triangles = 0;
  std::size_t faces = 0;      ///< distinct ids: a polygon of the file counts once
  std::size_t vertices = 0;   ///< as stored
  std::size_t positions = 0;  ///< distinct places of the vertices that triangles use
  Aabb bounds;
  double diagonal = 0;

  /// Triangles without area as far as doubles tell: points and segments to a probe. Counted among all else
  /// here but the aspect ratio.
  std::size_t degenerate = 0;
  std::size_t edges = 0;
  std::size_t boundary_edges = 0;         ///< with one triangle
  std::size_t non_manifold_edges = 0;     ///< with more than two
  std::int64_t euler_characteristic = 0;  ///< positions - edges + triangles
  bool closed = false;                    ///< every edge has two triangles
  bool oriented = false;                  ///< no two triangles run along an edge the same way

  double area = 0;
  std::optional<double> volume;  ///< closed and oriented meshes only; negative when oriented inwards
  double shortest_edge = 0, mean_edge = 0, longest_edge = 0;  ///< zero when there is no edge
  double worst_aspect_ratio = 0;  ///< longest edge over smallest height; zero when all are degenerate

  SideFinder::Surface sides;  ///< how inside and outside would be told apart
};

MeshReport report_on(const TriangleMesh& mesh);

/// Longest edge over smallest height, from the stored doubles; infinite without area.
double aspect_ratio(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace touchmark::bench::meshes
