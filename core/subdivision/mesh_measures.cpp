#include "core/subdivision/mesh_measures.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/subdivision/edge_map.h"
#include "core/subdivision/indexed_faces.h"
#include "core/subdivision/oriented_surface.h"

namespace touchmark {
namespace {

/// Returns the volume of the tetrahedron from `apex` to the triangle; positive where the triangle turns its
/// front away.
double tetrahedron(const TriangleMesh& mesh, std::size_t triangle, const Vec3& apex) {
  const Vec3 a = mesh.corner(triangle, 0) - apex;
  const Vec3 b = mesh.corner(triangle, 1) - apex;
  const Vec3 c = mesh.corner(triangle, 2) - apex;
  return a.dot(b.cross(c)) / 6;
}

/// The axis along which the points spread most.
int widest_axis(std::span<const Vec3> points) {
  Aabb box;
  for (const Vec3& p : points) box.extend(p);
  int axis = 0;
  box.extent().maxCoeff(&axis);
  return axis;
}

/// The mean of slack(radius, distance) over all pairs of a sphere and a centroid in it for which there is
/// one.
template <class Slack>
std::optional<double> mean_slack(std::span<const Vec3> centers, std::span<const double> radii,
                                 std::span<const Vec3> centroids, const Slack& slack) {
  if (centers.size() != radii.size())
    throw std::invalid_argument(std::to_string(centers.size()) + " centres for " +
                                std::to_string(radii.size()) + " radii");
  // Sorted along one axis, a sphere sees a slab of the centroids only.
  const int axis = widest_axis(centroids);
  std::vector<Vec3> sorted(centroids.begin(), centroids.end());
  const auto along = [axis](const Vec3& p) { return p[axis]; };
  std::ranges::stable_sort(sorted, {}, along);
  double sum = 0;
  std::size_t pairs = 0;
  for (std::size_t s = 0; s < centers.size(); ++s) {
    const Vec3& center = centers[s];
    // The first centroid that is not farther below the centre than the radius, as the distance itself rounds.
    auto p = std::ranges::partition_point(sorted,
                                          [&](const Vec3& q) { return center[axis] - q[axis] > radii[s]; });
    for (; p != sorted.end() && !((*p)[axis] - center[axis] > radii[s]); ++p) {
      const double distance = (*p - center).norm();
      if (!(distance <= radii[s])) continue;
      const std::optional<double> found = slack(radii[s], distance);
      if (!found) continue;
      sum += *found;
      ++pairs;
    }
  }
  if (pairs == 0) return std::nullopt;
  return sum / static_cast<double>(pairs);
}

}  // namespace

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const Vec3& a = mesh.corner(i, 0);
    sum += (mesh.corner(i, 1) - a).cross(mesh.corner(i, 2) - a).stableNorm() / 2;
  }
  return sum;
}

double signed_volume(const TriangleMesh& mesh) {
  const Vec3 center = mesh.bounds().center();
  double sum = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) sum += tetrahedron(mesh, i, center);
  return sum;
}

double absolute_volume(const TriangleMesh& mesh, const Vec3& center) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) sum += std::abs(tetrahedron(mesh, i, center));
  return sum;
}

EdgeStatistics edge_statistics(const TriangleMesh& mesh) {
  const IndexedTriangles welded = weld(mesh);
  const EdgeMap<3> edges(welded.faces, welded.positions.size());
  const TriangleSurface surface(welded.faces, edges, welded.positions.size());
  EdgeStatistics statistics;
  statistics.edges = edges.size();
  double sum = 0;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    using Location = TriangleSurface::Location;
    if (surface.location_of_edge(e) == Location::boundary) ++statistics.boundary;
    if (surface.location_of_edge(e) == Location::corner) ++statistics.seams;
    const auto [a, b] = edges.ends(e);
    const double length = (welded.positions[a] - welded.positions[b]).stableNorm();
    statistics.shortest = e == 0 ? length : std::min(statistics.shortest, length);
    statistics.longest = std::max(statistics.longest, length);
    sum += length;
  }
  if (edges.size() > 0) statistics.mean = sum / static_cast<double>(edges.size());
  return statistics;
}

std::optional<double> tightness(std::span<const Vec3> centers, std::span<const double> radii,
                                std::span<const Vec3> centroids) {
  return mean_slack(centers, radii, centroids,
                    [](double radius, double distance) { return radius - distance; });
}

std::optional<double> scale_free_tightness(std::span<const Vec3> centers, std::span<const double> radii,
                                           std::span<const Vec3> centroids) {
  return mean_slack(centers, radii, centroids, [](double radius, double distance) -> std::optional<double> {
    if (!(radius > 0)) return std::nullopt;
    return (radius - distance) / radius;
  });
}

}  // namespace touchmark
