#include "core/sphere_cluster/sphere_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/sphere_triangle_sweep.h"
#include "core/sphere_cluster/search_bounds.h"
#include "core/sphere_cluster/triangle_spheres.h"

namespace touchmark {
namespace {

constexpr std::uint32_t leaf_size = 4;
// Every split halves: 32 levels for 2^32 triangles, and one sibling waits for each.
constexpr std::size_t most_waiting = 40;

Vec3 centroid_of(const PreparedTriangle& t) noexcept {
  return t.corner[0] + ((t.corner[1] - t.corner[0]) + (t.corner[2] - t.corner[0])) / 3;
}

}  // namespace

SphereTree::SphereTree(const TriangleMesh& mesh, const SphereClusters& clusters)
    : ids_(mesh.ids().begin(), mesh.ids().end()) {
  triangles_.reserve(mesh.size());
  for (const std::uint32_t triangle : clusters.members) triangles_.push_back(prepare(mesh, triangle));
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(triangles_.size()));
  nodes_.shrink_to_fit();
}

void SphereTree::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  Aabb corners, centers;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Vec3& corner : triangles_[i].corner) corners.extend(corner);
    centers.extend(centroid_of(triangles_[i]));
  }
  Sphere sphere{corners.center(), 0};
  for (std::uint32_t i = begin; i < end; ++i)
    for (const Vec3& corner : triangles_[i].corner)
      sphere.radius = std::max(sphere.radius, radius_to(sphere.center, corner));
  nodes_[node].sphere = sphere;
  if (end - begin <= leaf_size) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  Eigen::Index axis = 0;
  centers.extent().maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle, triangles_.begin() + end,
                   [axis](const PreparedTriangle& a, const PreparedTriangle& b) {
                     const double x = centroid_of(a)[axis], y = centroid_of(b)[axis];
                     return x != y ? x < y : a.index < b.index;
                   });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = children;
  nodes_.resize(nodes_.size() + 2);
  build(children, begin, middle);
  build(children + 1, middle, end);
}

void SphereTree::consider(std::uint32_t triangle, const Vec3& center, Best& best, Work& work) const noexcept {
  const Candidate candidate{squared_distance(triangles_[triangle], center), triangles_[triangle].index};
  ++work.triangles;
  if (candidate < best.candidate) best = {candidate, triangle};
}

bool SphereTree::touches(const Probe& probe, Memory& memory, Work& work) const noexcept {
  return nearest(probe.center, probe.radius, memory, work).has_value();
}

std::optional<Contact> SphereTree::nearest(const Vec3& center, double reach, Memory& memory,
                                           Work& work) const noexcept {
  if (!(reach >= 0)) return std::nullopt;
  Best best;
  consider(memory.last < triangles_.size() ? memory.last : 0, center, best, work);
  struct Waiting {
    std::uint32_t node;
    double squared;
  };
  std::array<Waiting, most_waiting> waiting;
  std::size_t count = 0;
  waiting[count++] = {0, 0};
  while (count > 0) {
    const Node& node = nodes_[waiting[--count].node];
    const double bound = std::min(reach, std::sqrt(best.candidate.squared_distance));
    const double grown = grown_radius(node.sphere.radius, bound);
    ++work.spheres;
    if ((node.sphere.center - center).squaredNorm() > grown * grown) continue;
    if (node.count > 0) {
      for (std::uint32_t i = 0; i < node.count; ++i) consider(node.first + i, center, best, work);
      continue;
    }
    const double left = (nodes_[node.first].sphere.center - center).squaredNorm();
    const double right = (nodes_[node.first + 1].sphere.center - center).squaredNorm();
    const std::uint32_t near = right < left ? 1 : 0;
    waiting[count++] = {node.first + 1 - near, 0};
    waiting[count++] = {node.first + near, 0};
  }
  if (best.candidate.index >= triangles_.size()) return std::nullopt;
  memory.last = best.kept_at;
  if (!(std::sqrt(best.candidate.squared_distance) <= reach)) return std::nullopt;
  return contact_on(triangles_[best.kept_at], center, id(best.candidate.index));
}

std::optional<Impact> SphereTree::first_hit(const Sweep& sweep, Memory& memory, Work& work) const noexcept {
  if (const std::optional<Contact> start = nearest(sweep.from, sweep.radius, memory, work))
    return Impact{0, *start};
  const double reach = sweep.radius + sweep_slack(sweep);
  HitCandidate first;
  std::uint32_t kept_at = 0;
  std::array<std::uint32_t, most_waiting> waiting;
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[waiting[--count]];
    ++work.spheres;
    const double grown = grown_radius(node.sphere.radius, reach);
    const double limit = std::min(first.fraction, 1.0);
    if (squared_distance_to_way(sweep, limit, node.sphere.center) > grown * grown) continue;
    if (node.count == 0) {
      waiting[count++] = node.first + 1;
      waiting[count++] = node.first;
      continue;
    }
    work.triangles += node.count;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto fraction = sweep_hit(triangles_[i], sweep, std::min(first.fraction, 1.0));
      if (!fraction || !(HitCandidate{*fraction, triangles_[i].index} < first)) continue;
      first = {*fraction, triangles_[i].index};
      kept_at = i;
    }
  }
  if (first.index >= triangles_.size()) return std::nullopt;
  return Impact{first.fraction,
                contact_on(triangles_[kept_at], position_at(sweep, first.fraction), id(first.index))};
}

std::size_t SphereTree::bytes() const noexcept {
  return nodes_.capacity() * sizeof(Node) + triangles_.capacity() * sizeof(PreparedTriangle) +
         ids_.capacity() * sizeof(TriangleId);
}

}  // namespace touchmark
