#include "core/subdivision/catmull_clark.h"

#include "core/subdivision/edge_map.h"
#include "core/subdivision/oriented_surface.h"

namespace touchmark {
namespace {

using Points = std::vector<Vec3>;

template <std::size_t N>
Points face_points(const IndexedFaces<N>& mesh) {
  Points points;
  points.reserve(mesh.faces.size());
  for (const auto& face : mesh.faces) {
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t v : face) sum += mesh.positions[v];
    points.push_back(sum / N);
  }
  return points;
}

/// The middle of a triangle, or of the diagonal that a quadrilateral is cut along.
template <std::size_t N>
Points cut_points(const IndexedFaces<N>& mesh) {
  if constexpr (N == 3) return face_points(mesh);
  Points points;
  points.reserve(mesh.faces.size());
  for (const auto& face : mesh.faces)
    points.push_back((mesh.positions[face[0]] + mesh.positions[face[2]]) / 2);
  return points;
}

template <std::size_t N>
Points middles(const IndexedFaces<N>& mesh, const EdgeMap<N>& edges) {
  Points points;
  points.reserve(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges.ends(e);
    points.push_back((mesh.positions[a] + mesh.positions[b]) / 2);
  }
  return points;
}

/// The middle, drawn half-way to the two faces' points.
template <std::size_t N>
Points smooth_edge_points(const OrientedSurface<N>& surface, const Points& middle, const Points& face) {
  Points points = middle;
  for (std::uint32_t e = 0; e < points.size(); ++e) {
    if (surface.location_of_edge(e) != OrientedSurface<N>::Location::inside) continue;
    const auto sides = surface.edges().sides(e);
    points[e] = middle[e] / 2 + (face[sides[0] / N] + face[sides[1] / N]) / 4;
  }
  return points;
}

/// What the rules of a vertex sum up.
struct Around {
  Vec3 faces = Vec3::Zero();     ///< the faces' points
  Vec3 middles = Vec3::Zero();   ///< sum over all edges
  Vec3 boundary = Vec3::Zero();  ///< the middles of the boundary's edges
  std::uint32_t edges = 0;
};

template <std::size_t N>
std::vector<Around> sums_around(const IndexedFaces<N>& mesh, const OrientedSurface<N>& surface,
                                const Points& middle, const Points& face) {
  std::vector<Around> sums(mesh.positions.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::uint32_t v : mesh.faces[f]) sums[v].faces += face[f];
  for (std::uint32_t e = 0; e < middle.size(); ++e) {
    const bool on_boundary = surface.location_of_edge(e) == OrientedSurface<N>::Location::boundary;
    for (const std::uint32_t v : surface.edges().ends(e)) {
      ++sums[v].edges;
      sums[v].middles += middle[e];
      if (on_boundary) sums[v].boundary += middle[e];
    }
  }
  return sums;
}

/// (F + 2 R + (n - 3) P) / n: F and R the means of the n faces' points and of the n edges' middles. On a
/// boundary 3/4 P + 1/8 for each boundary neighbour, that is half P and a quarter of each boundary middle. A
/// corner stays.
template <std::size_t N>
Points smooth_vertices(const IndexedFaces<N>& mesh, const OrientedSurface<N>& surface, const Points& middle,
                       const Points& face) {
  using Location = typename OrientedSurface<N>::Location;
  const std::vector<Around> sums = sums_around(mesh, surface, middle, face);
  Points points = mesh.positions;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    const double n = sums[v].edges;
    if (surface.location(v) == Location::inside)
      points[v] = ((sums[v].faces + 2 * sums[v].middles) / n + (n - 3) * p) / n;
    else if (surface.location(v) == Location::boundary)
      points[v] = p / 2 + sums[v].boundary / 4;
  }
  return points;
}

}  // namespace

template <std::size_t N>
IndexedQuads catmull_clark(const IndexedFaces<N>& mesh, CatmullClarkPositions positions) {
  const EdgeMap<N> edges(mesh.faces, mesh.positions.size());
  const bool smooth = positions == CatmullClarkPositions::smooth;
  const Points face = smooth ? face_points(mesh) : cut_points(mesh);
  Points on_edges = middles(mesh, edges);

  IndexedQuads result;
  result.positions.reserve(mesh.positions.size() + edges.size() + mesh.faces.size());
  if (smooth) {
    const OrientedSurface<N> surface(mesh.faces, edges, mesh.positions.size());
    result.positions = smooth_vertices(mesh, surface, on_edges, face);
    on_edges = smooth_edge_points(surface, on_edges, face);
  } else {
    result.positions = mesh.positions;
  }
  result.positions.insert(result.positions.end(), on_edges.begin(), on_edges.end());
  result.positions.insert(result.positions.end(), face.begin(), face.end());

  const auto first_edge = static_cast<std::uint32_t>(mesh.positions.size());
  const auto first_face = static_cast<std::uint32_t>(first_edge + edges.size());
  result.faces.reserve(mesh.faces.size() * N);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t i = 0; i < N; ++i)
      result.faces.push_back({mesh.faces[f][i], first_edge + edges.edge(f, i), first_face + f,
                              first_edge + edges.edge(f, (i + N - 1) % N)});
  return result;
}

std::vector<TriangleMesh::Corners> triangulated(const IndexedQuads& mesh) {
  std::vector<TriangleMesh::Corners> triangles;
  triangles.reserve(mesh.faces.size() * 2);
  for (const auto& [vertex, edge, face, other_edge] : mesh.faces) {
    triangles.push_back({vertex, edge, face});
    triangles.push_back({vertex, face, other_edge});
  }
  return triangles;
}

template IndexedQuads catmull_clark<3>(const IndexedTriangles&, CatmullClarkPositions);
template IndexedQuads catmull_clark<4>(const IndexedQuads&, CatmullClarkPositions);

}  // namespace touchmark
