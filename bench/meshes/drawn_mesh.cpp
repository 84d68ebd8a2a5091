#include "bench/meshes/drawn_mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace touchmark::bench::meshes {
namespace {

/// Gives vertices of one cell one number, and its mean as their place. Cells are cubes of this edge.
class Clusters {
 public:
  Clusters(const Aabb& bounds, double cell) : low_(bounds.min), cell_(cell) {}

  std::uint32_t of(const Vec3& vertex) {
    const auto [found, fresh] = numbers_.try_emplace(key(vertex), static_cast<std::uint32_t>(sums_.size()));
    if (fresh) {
      sums_.push_back(Vec3::Zero());
      counts_.push_back(0);
    }
    // Sums of what is left above the box's corner: coordinates far off keep their digits.
    sums_[found->second] += vertex - low_;
    counts_[found->second] += 1;
    return found->second;
  }

  std::vector<Vec3> means() const {
    std::vector<Vec3> means;
    for (std::size_t i = 0; i < sums_.size(); ++i) means.push_back(low_ + sums_[i] / counts_[i]);
    return means;
  }

 private:
  std::uint64_t key(const Vec3& vertex) const {
    constexpr double most = (1 << 21) - 1;
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = cell_ > 0 ? std::floor((vertex[axis] - low_[axis]) / cell_) : 0;
      key = key << 21 | static_cast<std::uint64_t>(std::clamp(at, 0.0, most));
    }
    return key;
  }

  Vec3 low_;
  double cell_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
  std::vector<Vec3> sums_;
  std::vector<double> counts_;
};

DrawnMesh clustered(const TriangleMesh& mesh, double cell) {
  Clusters clusters(mesh.bounds(), cell);
  DrawnMesh drawn;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const std::uint32_t a = clusters.of(mesh.corner(i, 0));
    const std::uint32_t b = clusters.of(mesh.corner(i, 1));
    const std::uint32_t c = clusters.of(mesh.corner(i, 2));
    if (a == b || b == c || c == a) continue;
    // Begun at the least, so that triangles that became one are equal.
    if (a < b && a < c) drawn.triangles.push_back({a, b, c});
    if (b < a && b < c) drawn.triangles.push_back({b, c, a});
    if (c < a && c < b) drawn.triangles.push_back({c, a, b});
  }
  std::ranges::sort(drawn.triangles);
  drawn.triangles.erase(std::unique(drawn.triangles.begin(), drawn.triangles.end()), drawn.triangles.end());
  drawn.vertices = clusters.means();
  return drawn;
}

DrawnMesh whole(const TriangleMesh& mesh) {
  DrawnMesh drawn;
  const std::span<const Vec3> vertices = mesh.vertices();
  drawn.vertices.assign(vertices.begin(), vertices.end());
  const std::span<const TriangleMesh::Corners> triangles = mesh.triangles();
  drawn.triangles.assign(triangles.begin(), triangles.end());
  return drawn;
}

}  // namespace

DrawnMesh drawn_mesh(const TriangleMesh& mesh, std::size_t max_triangles) {
  if (mesh.size() <= max_triangles) return whole(mesh);
  // A surface that crosses n cells of the diagonal fills about n * n of them, and has two triangles in each.
  double cells = std::sqrt(static_cast<double>(max_triangles)) * 1.5;
  constexpr int attempts = 12;  // each has fewer triangles than the one before
  for (int i = 0; i < attempts; ++i) {
    DrawnMesh drawn = clustered(mesh, mesh.diagonal() / cells);
    if (drawn.triangles.size() <= max_triangles) return drawn;
    cells *=
        0.97 * std::sqrt(static_cast<double>(max_triangles) / static_cast<double>(drawn.triangles.size()));
  }
  return {};
}

}  // namespace touchmark::bench::meshes
