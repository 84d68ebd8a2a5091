#include "bench/meshes/mesh_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "bench/meshes/welded_mesh.h"
#include "core/exact/double_double.h"
#include "core/geometry/point_triangle.h"

namespace touchmark::bench::meshes {
namespace {

/// The cross product of slivers' edges, whose two terms nearly cancel.
Vec3 exact_cross(const Vec3& u, const Vec3& v) {
  const auto minor = [](double a, double b, double c, double d) {
    return (two_product(a, b) - two_product(c, d)).rounded();
  };
  return {minor(u.y(), v.z(), u.z(), v.y()), minor(u.z(), v.x(), u.x(), v.z()),
          minor(u.x(), v.y(), u.y(), v.x())};
}

/// stableNorm: squares of a small mesh's areas underflow.
double twice_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return exact_cross(b - a, c - a).stableNorm();
}

void measure_triangles(const TriangleMesh& mesh, MeshReport& report) {
  for (std::uint32_t t = 0; t < mesh.size(); ++t) {
    const Vec3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    report.area += 0.5 * twice_area(a, b, c);
    if (t == 0 || mesh.id(t) != mesh.id(t - 1)) ++report.faces;
    if (prepare(mesh, t).normal.isZero(0)) {
      ++report.degenerate;
    } else {
      report.worst_aspect_ratio = std::max(report.worst_aspect_ratio, aspect_ratio(a, b, c));
    }
  }
}

std::size_t count_used(const TriangleMesh& mesh, const WeldedMesh& welded) {
  std::vector<bool> used(welded.nodes.size());
  for (const TriangleMesh::Corners& corners : mesh.triangles())
    for (const std::uint32_t vertex : corners) used[welded.node_of[vertex]] = true;
  return static_cast<std::size_t>(std::ranges::count(used, true));
}

void measure_edges(const WeldedMesh& welded, MeshReport& report) {
  double sum = 0;
  report.shortest_edge = std::numeric_limits<double>::infinity();
  report.oriented = true;
  welded.each_edge([&](std::span<const TriangleSide> sides) {
    ++report.edges;
    if (sides.size() == 1) ++report.boundary_edges;
    if (sides.size() > 2) ++report.non_manifold_edges;
    const auto forward = std::ranges::count_if(sides, [](const auto& side) { return side.forward; });
    if (forward > 1 || static_cast<std::ptrdiff_t>(sides.size()) - forward > 1) report.oriented = false;

    const double length = (welded.nodes[sides[0].high] - welded.nodes[sides[0].low]).stableNorm();
    sum += length;
    report.shortest_edge = std::min(report.shortest_edge, length);
    report.longest_edge = std::max(report.longest_edge, length);
  });
  if (report.edges == 0) report.shortest_edge = 0;
  report.mean_edge = report.edges == 0 ? 0 : sum / static_cast<double>(report.edges);
  report.closed = report.edges > 0 && report.boundary_edges == 0 && report.non_manifold_edges == 0;
  report.oriented = report.oriented && report.edges > 0;
}

/// Tetrahedra about the box's centre, which keeps far offsets out of the products.
double signed_volume(const TriangleMesh& mesh) {
  const Vec3 center = mesh.bounds().center();
  double six_volumes = 0;
  for (std::size_t t = 0; t < mesh.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - center, b = mesh.corner(t, 1) - center, c = mesh.corner(t, 2) - center;
    six_volumes += a.dot(b.cross(c));
  }
  return six_volumes / 6;
}

}  // namespace

double aspect_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({(b - a).stableNorm(), (c - b).stableNorm(), (a - c).stableNorm()});
  const double area = twice_area(a, b, c);
  return area > 0 ? longest * (longest / area) : std::numeric_limits<double>::infinity();
}

MeshReport report_on(const TriangleMesh& mesh) {
  MeshReport report;
  report.triangles = mesh.size();
  report.vertices = mesh.vertices().size();
  report.bounds = mesh.bounds();
  report.diagonal = mesh.diagonal();
  measure_triangles(mesh, report);

  const WeldedMesh welded(mesh);
  report.positions = count_used(mesh, welded);
  measure_edges(welded, report);
  report.euler_characteristic = static_cast<std::int64_t>(report.positions) -
                                static_cast<std::int64_t>(report.edges) +
                                static_cast<std::int64_t>(report.triangles);
  if (report.closed && report.oriented) report.volume = signed_volume(mesh);
  report.sides = SideFinder::build(mesh).surface();
  return report;
}

}  // namespace touchmark::bench::meshes
