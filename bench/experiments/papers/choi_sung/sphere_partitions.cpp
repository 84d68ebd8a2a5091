#include "bench/experiments/papers/choi_sung/sphere_partitions.h"

#include <algorithm>
#include <numeric>
#include <queue>
#include <span>
#include <utility>

#include "core/aabb.h"
#include "core/sphere_cluster/published/triangle_spheres.h"
#include "core/subdivision/mesh_measures.h"

namespace touchmark::bench::experiments::papers {
namespace {

struct Part {
  std::vector<std::uint32_t> triangles;
  double side = 0;  ///< the longest of the centroids' box
  int axis = 0;

  bool operator<(const Part& other) const { return side < other.side; }
};

Part part_of(std::vector<std::uint32_t> triangles, std::span<const Vec3> centroids) {
  Aabb box;
  for (const std::uint32_t i : triangles) box.extend(centroids[i]);
  Part part{std::move(triangles)};
  part.side = (box.max - box.min).maxCoeff(&part.axis);
  return part;
}

std::pair<Part, Part> halves(Part part, std::span<const Vec3> centroids) {
  std::vector<std::uint32_t>& all = part.triangles;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double x = centroids[a][part.axis], y = centroids[b][part.axis];
    return x != y ? x < y : a < b;
  });
  return {part_of({all.begin(), middle}, centroids), part_of({middle, all.end()}, centroids)};
}

Sphere smallest_around(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
  std::vector<Vec3> corners;
  for (const std::uint32_t triangle : triangles)
    for (int k = 0; k < 3; ++k) corners.push_back(mesh.corner(triangle, k));
  return smallest_sphere(corners);
}

double tightness_of(std::span<const Sphere> spheres, std::span<const Vec3> centroids) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const Sphere& sphere : spheres) {
    centers.push_back(sphere.center);
    radii.push_back(sphere.radius);
  }
  return tightness(centers, radii, centroids).value_or(0);
}

}  // namespace

std::vector<std::vector<std::uint32_t>> halved_into(const TriangleMesh& mesh, std::size_t parts) {
  const std::vector<Vec3> middles = centroids(mesh);
  std::vector<std::uint32_t> all(mesh.size());
  std::iota(all.begin(), all.end(), 0u);
  std::priority_queue<Part> open;
  std::vector<std::vector<std::uint32_t>> done;
  open.push(part_of(std::move(all), middles));
  while (!open.empty() && open.size() + done.size() < parts) {
    Part widest = open.top();
    open.pop();
    if (widest.triangles.size() < 2) {
      done.push_back(std::move(widest.triangles));
      continue;
    }
    auto [low, high] = halves(std::move(widest), middles);
    open.push(std::move(low));
    open.push(std::move(high));
  }
  for (; !open.empty(); open.pop()) done.push_back(open.top().triangles);
  return done;
}

PartitionTightness partition_tightness(const TriangleMesh& mesh, const SphereClusters& clusters) {
  const std::vector<Vec3> middles = centroids(mesh);
  std::vector<Sphere> bottom_up, top_down;
  for (std::size_t i = 0; i < clusters.size(); ++i)
    bottom_up.push_back(smallest_around(mesh, clusters.triangles_of(i)));
  for (const std::vector<std::uint32_t>& part : halved_into(mesh, clusters.size()))
    top_down.push_back(smallest_around(mesh, part));
  return {tightness_of(clusters.spheres, middles), tightness_of(bottom_up, middles),
          tightness_of(top_down, middles)};
}

}  // namespace touchmark::bench::experiments::papers
