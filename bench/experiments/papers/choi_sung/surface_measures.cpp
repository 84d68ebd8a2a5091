#include "bench/experiments/papers/choi_sung/surface_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "bench/meshes/welded_mesh.h"
#include "core/sphere_cluster/published/triangle_spheres.h"
#include "core/subdivision/mesh_measures.h"

namespace touchmark::bench::experiments::papers {
namespace {

/// object.position in the paper's volume: the origin, unless the mesh lies elsewhere.
Vec3 volume_center(const TriangleMesh& original) {
  const Aabb& box = original.bounds();
  return box.contains(Vec3::Zero()) ? Vec3(Vec3::Zero()) : Vec3(box.center());
}

Vec3 face_normal(const TriangleMesh& mesh, std::uint32_t triangle) {
  const Vec3& a = mesh.corner(triangle, 0);
  return (mesh.corner(triangle, 1) - a).cross(mesh.corner(triangle, 2) - a).stableNormalized();
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Calls visit(low, high, angle, across) for every edge of two triangles: its nodes, how far the faces turn
/// there, and how far in front of the first the middle of the second lies.
template <class Visitor>
void each_crease(const TriangleMesh& mesh, const meshes::WeldedMesh& welded, const Visitor& visit) {
  welded.each_edge([&](std::span<const meshes::TriangleSide> sides) {
    if (sides.size() != 2) return;
    const Vec3 normal = face_normal(mesh, sides[0].triangle);
    visit(sides[0].low, sides[0].high, angle_between(normal, face_normal(mesh, sides[1].triangle)),
          normal.dot(centroid(mesh, sides[1].triangle) - welded.nodes[sides[0].low]));
  });
}

/// The nodes, the one with the sharpest edge first.
std::vector<Vec3> sharpest_first(const TriangleMesh& mesh) {
  const meshes::WeldedMesh welded(mesh);
  std::vector<double> sharpest(welded.nodes.size());
  each_crease(mesh, welded, [&](std::uint32_t low, std::uint32_t high, double angle, double) {
    for (const std::uint32_t node : {low, high}) sharpest[node] = std::max(sharpest[node], angle);
  });
  std::vector<std::size_t> order(welded.nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return sharpest[a] > sharpest[b]; });
  std::vector<Vec3> nodes;
  for (const std::size_t i : order) nodes.push_back(welded.nodes[i]);
  return nodes;
}

double distance_to(const SphereCluster& surface, const Vec3& point, SphereCluster::Session& session) {
  return surface.nearest({point, 0}, std::numeric_limits<double>::infinity(), session)->distance;
}

/// Shortest, middle, longest.
std::array<double, 3> edges_of(const TriangleMesh& mesh, std::size_t triangle) {
  std::array<double, 3> edges{};
  for (int k = 0; k < 3; ++k)
    edges[static_cast<std::size_t>(k)] =
        (mesh.corner(triangle, (k + 1) % 3) - mesh.corner(triangle, k)).norm();
  std::ranges::sort(edges);
  return edges;
}

double double_area(const TriangleMesh& mesh, std::size_t triangle) {
  const Vec3& a = mesh.corner(triangle, 0);
  return (mesh.corner(triangle, 1) - a).cross(mesh.corner(triangle, 2) - a).norm();
}

/// Mean radii of the two spheres that may stand for a triangle; those without area are left out.
void measure_spheres(const TriangleMesh& mesh, SurfaceMeasures& measures) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const double twice_area = double_area(mesh, i);
    if (!(twice_area > 0)) continue;
    const auto [a, b, c] = edges_of(mesh, i);
    measures.circumradius += a * b * c / (2 * twice_area);
    measures.centroid_radius += radius_around(mesh, i, centroid(mesh, i));
    ++count;
  }
  if (count == 0) return;
  measures.circumradius /= static_cast<double>(count);
  measures.centroid_radius /= static_cast<double>(count);
}

}  // namespace

void each_crease(const TriangleMesh& mesh, const std::function<void(double, double)>& visit) {
  const meshes::WeldedMesh welded(mesh);
  each_crease(mesh, welded, [&](std::uint32_t low, std::uint32_t high, double angle, double) {
    visit((welded.nodes[low] - welded.nodes[high]).norm(), angle);
  });
}

double crease_deg(const TriangleMesh& mesh) {
  double sum = 0, length = 0;
  each_crease(mesh, [&](double edge, double angle) {
    sum += edge * angle * angle;
    length += edge;
  });
  return length > 0 ? std::sqrt(sum / length) * 180 / std::numbers::pi : 0;
}

double concave_bending(const TriangleMesh& mesh) {
  const meshes::WeldedMesh welded(mesh);
  const double outwards = signed_volume(mesh) < 0 ? -1 : 1;
  double sum = 0;
  each_crease(mesh, welded, [&](std::uint32_t low, std::uint32_t high, double angle, double across) {
    if (outwards * across > 0) sum += (welded.nodes[low] - welded.nodes[high]).norm() * angle;
  });
  return sum;
}

double mean_edge_ratio(const TriangleMesh& mesh) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const auto edges = edges_of(mesh, i);
    if (!(double_area(mesh, i) > 0)) continue;
    sum += edges[2] / edges[0];
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

SurfaceRuler::SurfaceRuler(const TriangleMesh& original)
    : original_(original),
      nearest_(SphereCluster::build(original)),
      nodes_(sharpest_first(original)),
      volume_(absolute_volume(original, volume_center(original))) {}

SurfaceMeasures SurfaceRuler::measure(std::string method, int level, const TriangleMesh& mesh) const {
  SurfaceMeasures measures;
  measures.method = std::move(method);
  measures.level = level;
  measures.triangles = mesh.size();
  measures.mean_area = mean_triangle_area(mesh);
  measures.relative_volume = absolute_volume(mesh, volume_center(original_)) / volume_;
  measures.crease_deg = crease_deg(mesh);
  measures.vertices = meshes::WeldedMesh(mesh).nodes.size();
  measures.mean_edge_ratio = mean_edge_ratio(mesh);
  measures.concave_bending = concave_bending(mesh);
  measures.mean_offset = mean_offset(mesh);
  compare_vertices(mesh, measures);
  measure_spheres(mesh, measures);
  return measures;
}

double SurfaceRuler::mean_offset(const TriangleMesh& mesh) const {
  SphereCluster::Session session;
  double sum = 0, whole = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const double weight = double_area(mesh, i);
    sum += weight * distance_to(nearest_, centroid(mesh, i), session);
    whole += weight;
  }
  return whole > 0 ? sum / whole : 0;
}

void SurfaceRuler::compare_vertices(const TriangleMesh& mesh, SurfaceMeasures& measures) const {
  const SphereCluster surface = SphereCluster::build(mesh);
  SphereCluster::Session session;
  // MeshLab keeps positions as floats.
  const double rounding =
      4 * std::numeric_limits<float>::epsilon() *
      original_.bounds().min.cwiseAbs().cwiseMax(original_.bounds().max.cwiseAbs()).maxCoeff();
  const std::size_t tenth = std::max<std::size_t>(nodes_.size() / 10, 1);
  double sharpest = 0, all = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double off = distance_to(surface, nodes_[i], session);
    measures.keeps_vertices = measures.keeps_vertices && off <= rounding;
    all += off;
    if (i < tenth) sharpest += off;
  }
  measures.vertex_offset = all / static_cast<double>(nodes_.size());
  if (!measures.keeps_vertices)
    measures.shrinkage_at_creases = sharpest / static_cast<double>(tenth) / measures.vertex_offset;
}

}  // namespace touchmark::bench::experiments::papers
