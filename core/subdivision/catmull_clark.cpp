#include "core/subdivision/catmull_clark.h"

#include "core/subdivision/edge_map.h"

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
Points smooth_edge_points(const EdgeMap<N>& edges, const Points& middle, const Points& face) {
  Points points = middle;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.sides(e);
    if (sides.size() == 2) points[e] = middle[e] / 2 + (face[sides[0] / N] + face[sides[1] / N]) / 4;
  }
  return points;
}

/// (F + 2 R + (n - 3) P) / n: F and R the means of the n faces' points and of the n edges' middles. On a
/// boundary 3/4 P + 1/8 for each boundary neighbour, that is half P and a quarter of each boundary middle.
template <std::size_t N>
Points smooth_vertices(const IndexedFaces<N>& mesh, const EdgeMap<N>& edges, const Points& middle,
                       const Points& face) {
  const std::size_t vertices = mesh.positions.size();
  Points faces(vertices, Vec3::Zero()), around(vertices, Vec3::Zero()), along(vertices, Vec3::Zero());
  std::vector<std::uint32_t> valence(vertices, 0);
  std::vector<bool> boundary(vertices, false);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::uint32_t v : mesh.faces[f]) faces[v] += face[f];
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (const std::uint32_t v : edges.ends(e)) {
      ++valence[v];
      around[v] += middle[e];
      if (edges.sides(e).size() != 1) continue;
      boundary[v] = true;
      along[v] += middle[e];
    }
  }
  Points points;
  points.reserve(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const Vec3& p = mesh.positions[v];
    const double n = valence[v];
    points.push_back(boundary[v] ? Vec3(p / 2 + along[v] / 4)
                                 : Vec3((faces[v] / n + 2 * around[v] / n + (n - 3) * p) / n));
  }
  return points;
}

}  // namespace

template <std::size_t N>
IndexedQuads catmull_clark(const IndexedFaces<N>& mesh, CatmullClarkPositions positions) {
  const EdgeMap<N> edges(mesh.faces, mesh.positions.size());
  const bool smooth = positions == CatmullClarkPositions::smooth;
  const Points face = smooth ? face_points(mesh) : cut_points(mesh);
  const Points middle = middles(mesh, edges);

  IndexedQuads result;
  result.positions.reserve(mesh.positions.size() + edges.size() + mesh.faces.size());
  result.positions = smooth ? smooth_vertices(mesh, edges, middle, face) : mesh.positions;
  const Points on_edges = smooth ? smooth_edge_points(edges, middle, face) : middle;
  result.positions.insert(result.positions.end(), on_edges.begin(), on_edges.end());
  result.positions.insert(result.positions.end(), face.begin(), face.end());

  const auto first_edge = static_cast<std::uint32_t>(mesh.positions.size());
  const auto first_face = static_cast<std::uint32_t>(first_edge + edges.size());
  result.faces.reserve(mesh.faces.size() * N);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::size_t i = 0; i < N; ++i) {
      result.faces.push_back({mesh.faces[f][i], first_edge + edges.edge(f, i), first_face + f,
                              first_edge + edges.edge(f, (i + N - 1) % N)});
    }
  }
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
