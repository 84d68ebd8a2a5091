#include "bench/trajectories/mesh_edges.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "bench/meshes/welded_mesh.h"
#include "core/geometry/point_triangle.h"

namespace touchmark::bench::trajectories {
namespace {

constexpr double cosine_of_sharp = 0.8660254037844386;  // 30 degrees

/// A face at an edge, and whether it runs along the edge from its lower node to its higher.
struct Face {
  Vec3 normal;
  bool forward;
};

bool is_sharp(std::span<const Face> faces) {
  if (faces.empty()) return false;  // only triangles without area: nothing to feel
  if (faces.size() == 1) return true;
  if (faces.size() == 2) {
    // Two faces that run along their edge the same way are oriented against each other.
    const double cosine = faces[0].normal.dot(faces[1].normal);
    return (faces[0].forward == faces[1].forward ? -cosine : cosine) < cosine_of_sharp;
  }
  return std::ranges::any_of(
      faces, [&](const Face& face) { return std::abs(face.normal.dot(faces[0].normal)) < cosine_of_sharp; });
}

Vec3 bisector_of(std::span<const Face> faces, const Vec3& along) {
  Vec3 sum = Vec3::Zero();
  for (const Face& face : faces) sum += face.normal;
  if (sum.norm() > 1e-6) return sum.normalized();
  if (!faces.empty()) return faces[0].normal;
  return (along / along.cwiseAbs().maxCoeff()).unitOrthogonal();
}

}  // namespace

MeshEdges::MeshEdges(const TriangleMesh& mesh) {
  meshes::WeldedMesh welded(mesh);
  nodes_ = std::move(welded.nodes);
  std::vector<Face> faces;
  welded.each_edge([&](std::span<const meshes::TriangleSide> sides) {
    faces.clear();
    for (const meshes::TriangleSide& side : sides) {
      const Vec3 normal = prepare(mesh, side.triangle).normal;
      if (!normal.isZero(0)) faces.push_back({normal, side.forward});
    }
    const Vec3 along = nodes_[sides[0].high] - nodes_[sides[0].low];
    edges_.push_back({sides[0].low, sides[0].high, bisector_of(faces, along), is_sharp(faces)});
  });
  link();
}

void MeshEdges::link() {
  first_.assign(nodes_.size() + 1, 0);
  for (const MeshEdge& edge : edges_) {
    ++first_[edge.from + 1];
    ++first_[edge.to + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  incident_.resize(2 * edges_.size());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    incident_[next[edges_[e].from]++] = e;
    incident_[next[edges_[e].to]++] = e;
  }
}

}  // namespace touchmark::bench::trajectories
