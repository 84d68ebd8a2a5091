#include "bench/mesh_edges.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <Eigen/Geometry>

#include "core/geometry/point_triangle.h"

namespace touchmark::bench {
namespace {

constexpr double cosine_of_sharp = 0.8660254037844386;  // 30 degrees

/// One side of a triangle, named from its lower node.
struct Side {
  std::uint32_t low, high, triangle;
  bool forward;  ///< the triangle runs from low to high
};

bool precedes(const Vec3& a, const Vec3& b) {
  return std::make_tuple(a.x(), a.y(), a.z()) < std::make_tuple(b.x(), b.y(), b.z());
}

struct Welded {
  std::vector<Vec3> nodes;
  std::vector<std::uint32_t> node_of;  ///< one a vertex
};

Welded weld(std::span<const Vec3> vertices) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return precedes(vertices[a], vertices[b]) || (vertices[a] == vertices[b] && a < b);
  });
  Welded welded;
  welded.node_of.resize(vertices.size());
  for (const std::uint32_t vertex : order) {
    if (welded.nodes.empty() || welded.nodes.back() != vertices[vertex])
      welded.nodes.push_back(vertices[vertex]);
    welded.node_of[vertex] = static_cast<std::uint32_t>(welded.nodes.size() - 1);
  }
  return welded;
}

std::vector<Side> sides_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& node_of) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.size());
  for (std::uint32_t t = 0; t < mesh.size(); ++t) {
    const TriangleMesh::Corners& corners = mesh.triangles()[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = node_of[corners[i]], b = node_of[corners[(i + 1) % 3]];
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle, a.forward) < std::tie(b.low, b.high, b.triangle, b.forward);
  });
  return sides;
}

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
  return std::any_of(faces.begin(), faces.end(), [&](const Face& face) {
    return std::abs(face.normal.dot(faces[0].normal)) < cosine_of_sharp;
  });
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
  Welded welded = weld(mesh.vertices());
  nodes_ = std::move(welded.nodes);
  const std::vector<Side> sides = sides_of(mesh, welded.node_of);
  std::vector<Face> faces;
  for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
    faces.clear();
    for (next = i;
         next < sides.size() && sides[next].low == sides[i].low && sides[next].high == sides[i].high;
         ++next) {
      const Vec3 normal = prepare(mesh, sides[next].triangle).normal;
      if (!normal.isZero(0)) faces.push_back({normal, sides[next].forward});
    }
    const Vec3 along = nodes_[sides[i].high] - nodes_[sides[i].low];
    edges_.push_back({sides[i].low, sides[i].high, bisector_of(faces, along), is_sharp(faces)});
  }
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

}  // namespace touchmark::bench
