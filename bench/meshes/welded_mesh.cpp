#include "bench/meshes/welded_mesh.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace touchmark::bench::meshes {
namespace {

bool precedes(const Vec3& a, const Vec3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

}  // namespace

WeldedMesh::WeldedMesh(const TriangleMesh& mesh) {
  const std::span<const Vec3> vertices = mesh.vertices();
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return precedes(vertices[a], vertices[b]) || (vertices[a] == vertices[b] && a < b);
  });
  node_of.resize(vertices.size());
  for (const std::uint32_t vertex : order) {
    if (nodes.empty() || nodes.back() != vertices[vertex]) nodes.push_back(vertices[vertex]);
    node_of[vertex] = static_cast<std::uint32_t>(nodes.size() - 1);
  }

  sides.reserve(3 * mesh.size());
  for (std::uint32_t t = 0; t < mesh.size(); ++t) {
    const TriangleMesh::Corners& corners = mesh.triangles()[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = node_of[corners[i]], b = node_of[corners[(i + 1) % 3]];
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  }
  std::ranges::sort(sides, [](const TriangleSide& a, const TriangleSide& b) {
    return std::tie(a.low, a.high, a.triangle, a.forward) < std::tie(b.low, b.high, b.triangle, b.forward);
  });
}

}  // namespace touchmark::bench::meshes
