#include "core/subdivision/indexed_faces.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace touchmark {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

bool before(const Vec3& a, const Vec3& b) noexcept {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

/// For each vertex the first one at its coordinates.
std::vector<std::uint32_t> first_alike(std::span<const Vec3> vertices) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    if (before(vertices[i], vertices[j])) return true;
    return !before(vertices[j], vertices[i]) && i < j;
  });
  std::vector<std::uint32_t> first(vertices.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool alike = k > 0 && vertices[order[k - 1]] == vertices[order[k]];
    first[order[k]] = alike ? first[order[k - 1]] : order[k];
  }
  return first;
}

/// The vertices that triangles use keep their order.
void take_used(std::span<const Vec3> vertices, IndexedTriangles& welded) {
  std::vector<std::uint32_t> number(vertices.size(), none);
  for (const auto& corners : welded.faces)
    for (const std::uint32_t v : corners) number[v] = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (number[v] == none) continue;
    number[v] = static_cast<std::uint32_t>(welded.positions.size());
    welded.positions.push_back(vertices[v]);
  }
  for (auto& corners : welded.faces)
    for (std::uint32_t& v : corners) v = number[v];
}

}  // namespace

IndexedTriangles weld(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> first = first_alike(mesh.vertices());
  IndexedTriangles welded;
  for (const auto& [a, b, c] : mesh.triangles()) {
    const TriangleMesh::Corners corners = {first[a], first[b], first[c]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    welded.faces.push_back(corners);
  }
  take_used(mesh.vertices(), welded);
  return welded;
}

}  // namespace touchmark
