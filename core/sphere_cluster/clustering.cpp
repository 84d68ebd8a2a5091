#include "core/sphere_cluster/clustering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "core/sphere_cluster/published/triangle_spheres.h"

namespace touchmark {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// One side of a triangle; sides with equal ends are shared edges.
struct TriangleSide {
  std::uint64_t ends;
  std::uint32_t triangle;
};

std::uint64_t side_key(const TriangleMesh::Corners& corners, std::size_t k) noexcept {
  const std::uint64_t a = corners[k], b = corners[k == 2 ? 0 : k + 1];
  return std::min(a, b) << 32 | std::max(a, b);
}

/// Sorted by ends, then triangle.
std::vector<TriangleSide> sorted_sides(const TriangleMesh& mesh) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * mesh.size());
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) sides.push_back({side_key(mesh.triangles()[i], k), i});
  std::sort(sides.begin(), sides.end(), [](const TriangleSide& a, const TriangleSide& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.triangle < b.triangle;
  });
  return sides;
}

/// Leaders by the cell of a grid at least as wide as the clustering distance, so that those within it lie in
/// 27 cells.
class LeaderGrid {
 public:
  LeaderGrid(const Aabb& bounds, double distance)
      : origin_(bounds.min),
        // No finer than 2^-40 of the mesh, so that cell numbers stay exact.
        cell_(std::max(distance, std::ldexp(bounds.extent().maxCoeff(), -40))) {}

  void add(const Vec3& position, std::uint32_t leader) {
    std::uint32_t& head = cells_.try_emplace(cell_of(position), none).first->second;
    entries_.push_back({position, leader, head});
    head = static_cast<std::uint32_t>(entries_.size() - 1);
  }

  /// The nearest leader within the distance, the earlier one of two as near, or `none`.
  std::uint32_t nearest(const Vec3& position, double distance) const {
    std::uint32_t found = none;
    double best = distance * distance;
    const Cell center = cell_of(position);
    for (std::int64_t x = -1; x <= 1; ++x)
      for (std::int64_t y = -1; y <= 1; ++y)
        for (std::int64_t z = -1; z <= 1; ++z) {
          const auto cell = cells_.find({center[0] + x, center[1] + y, center[2] + z});
          if (cell == cells_.end()) continue;
          for (std::uint32_t e = cell->second; e != none; e = entries_[e].next) {
            const double squared = (entries_[e].position - position).squaredNorm();
            if (squared < best || (squared == best && entries_[e].leader < found)) {
              best = squared;
              found = entries_[e].leader;
            }
          }
        }
    return found;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const noexcept {
      std::uint64_t hash = 0;
      for (const std::int64_t k : cell) {
        hash = (hash ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15ULL;
        hash ^= hash >> 29;
      }
      return hash;
    }
  };
  struct Entry {
    Vec3 position;
    std::uint32_t leader;
    std::uint32_t next;
  };

  Cell cell_of(const Vec3& position) const noexcept {
    const Vec3 scaled = (position - origin_) / cell_;
    return {static_cast<std::int64_t>(std::floor(scaled.x())),
            static_cast<std::int64_t>(std::floor(scaled.y())),
            static_cast<std::int64_t>(std::floor(scaled.z()))};
  }

  Vec3 origin_;
  double cell_;
  std::unordered_map<Cell, std::uint32_t, CellHash> cells_;
  std::vector<Entry> entries_;
};

/// The cluster of each triangle, and the leaders in the order in which they arose.
struct Assignment {
  std::vector<std::uint32_t> cluster;
  std::vector<std::uint32_t> leaders;
};

std::vector<std::uint32_t> mesh_order(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.size());
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

Assignment follow_leaders(const TriangleMesh& mesh, const std::vector<Vec3>& centers, double distance,
                          VisitOrder order) {
  Assignment assignment;
  assignment.cluster.resize(mesh.size());
  if (!(mesh.bounds().extent().maxCoeff() > 0)) {  // every corner in one place
    assignment.leaders = {0};
    return assignment;
  }
  LeaderGrid grid(mesh.bounds(), distance);
  for (const std::uint32_t triangle :
       order == VisitOrder::mesh ? mesh_order(mesh) : breadth_first_order(mesh)) {
    std::uint32_t cluster = grid.nearest(centers[triangle], distance);
    if (cluster == none) {
      cluster = static_cast<std::uint32_t>(assignment.leaders.size());
      assignment.leaders.push_back(triangle);
      grid.add(centers[triangle], cluster);
    }
    assignment.cluster[triangle] = cluster;
  }
  return assignment;
}

/// Members of each cluster, the leader first, the others in the mesh's order.
void gather_members(const Assignment& assignment, SphereClusters& clusters) {
  const std::size_t count = assignment.leaders.size();
  clusters.first.assign(count + 1, 0);
  for (const std::uint32_t cluster : assignment.cluster) ++clusters.first[cluster + 1];
  std::partial_sum(clusters.first.begin(), clusters.first.end(), clusters.first.begin());
  clusters.members.resize(assignment.cluster.size());
  std::vector<std::uint32_t> next(clusters.first.begin(), clusters.first.end() - 1);
  for (std::size_t i = 0; i < count; ++i) clusters.members[next[i]++] = assignment.leaders[i];
  for (std::uint32_t i = 0; i < assignment.cluster.size(); ++i) {
    const std::uint32_t cluster = assignment.cluster[i];
    if (i != assignment.leaders[cluster]) clusters.members[next[cluster]++] = i;
  }
}

SphereClusters one_a_triangle(const TriangleMesh& mesh, unsigned threads) {
  SphereClusters clusters;
  clusters.spheres = triangle_spheres(mesh, threads);
  clusters.first.resize(mesh.size() + 1);
  std::iota(clusters.first.begin(), clusters.first.end(), 0U);
  clusters.members.assign(clusters.first.begin(), clusters.first.end() - 1);
  return clusters;
}

}  // namespace

std::vector<std::uint32_t> breadth_first_order(const TriangleMesh& mesh) {
  const std::vector<TriangleSide> sides = sorted_sides(mesh);
  const auto first_side = [&](std::uint64_t ends) {
    return std::lower_bound(sides.begin(), sides.end(), ends,
                            [](const TriangleSide& side, std::uint64_t key) { return side.ends < key; });
  };
  std::vector<bool> seen(mesh.size(), false);
  std::vector<bool> crossed(sides.size(), false);  // at an edge's first side: all its triangles are seen
  std::vector<std::uint32_t> order;                // its own queue
  order.reserve(mesh.size());
  const auto visit = [&](std::uint32_t triangle) {
    if (seen[triangle]) return;
    seen[triangle] = true;
    order.push_back(triangle);
  };
  std::size_t served = 0;
  for (std::uint32_t seed = 0; seed < mesh.size(); ++seed) {
    visit(seed);
    for (; served < order.size(); ++served) {
      const TriangleMesh::Corners& corners = mesh.triangles()[order[served]];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint64_t ends = side_key(corners, k);
        auto side = first_side(ends);
        const auto edge = static_cast<std::size_t>(side - sides.begin());
        if (crossed[edge]) continue;
        crossed[edge] = true;
        for (; side != sides.end() && side->ends == ends; ++side) visit(side->triangle);
      }
    }
  }
  return order;
}

SphereClusters cluster_spheres(const TriangleMesh& mesh, double distance, VisitOrder order,
                               unsigned threads) {
  if (!(distance >= 0) || std::isinf(distance))
    throw std::invalid_argument("sphere-cluster: clustering is " + std::to_string(distance) +
                                ", not a finite distance of at least 0");
  if (!(distance > 0)) return one_a_triangle(mesh, threads);
  const std::vector<Vec3> centers = centroids(mesh);
  const Assignment assignment = follow_leaders(mesh, centers, distance, order);
  SphereClusters clusters;
  gather_members(assignment, clusters);
  clusters.spheres.reserve(assignment.leaders.size());
  for (std::size_t i = 0; i < assignment.leaders.size(); ++i) {
    Sphere sphere{centers[assignment.leaders[i]], 0};
    for (const std::uint32_t triangle : clusters.triangles_of(i))
      sphere.radius = std::max(sphere.radius, radius_around(mesh, triangle, sphere.center));
    clusters.spheres.push_back(sphere);
  }
  return clusters;
}

double average_tightness(const TriangleMesh& mesh, const SphereClusters& clusters) {
  double sum = 0;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const Sphere& sphere = clusters.spheres[i];
    sum += sphere.radius;  // the leader's centroid is the centre
    for (const std::uint32_t triangle : clusters.triangles_of(i).subspan(1))
      sum += sphere.radius - safe_norm(centroid(mesh, triangle) - sphere.center);
  }
  return sum / static_cast<double>(clusters.members.size());
}

}  // namespace touchmark
