#include "bench/experiments/stress/questions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bench/experiments/stress/hard_centers.h"
#include "bench/oracle/oracle.h"

namespace touchmark::bench {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t radii_a_centre = 3;

}  // namespace

std::vector<Step> at_the_exact_distance(const TriangleMesh& mesh, const std::vector<Vec3>& centers) {
  std::vector<Probe> probes;
  for (const Vec3& center : centers) probes.push_back({center, 0});
  const std::vector<Truth> truths = Oracle(mesh).solve(probes);
  std::vector<Step> course;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const double distance = truths[i].high;
    if (!truths[i].defined || !std::isfinite(distance)) continue;
    if (distance > 0) course.push_back(asked(centers[i], std::nextafter(distance, 0)));
    course.push_back(asked(centers[i], distance));
    course.push_back(asked(centers[i], std::nextafter(distance, infinity)));
  }
  return course;
}

Workload about(NamedMesh mesh, std::string course_name, std::vector<Step> course) {
  return {std::move(mesh.name), std::move(mesh.mesh), 0, {}, {std::move(course_name)}, {std::move(course)}};
}

std::size_t share_of(std::size_t probes, std::size_t parts) {
  return std::max<std::size_t>(probes / parts, 1);
}

std::vector<Workload> hard_questions(std::vector<NamedMesh> meshes, std::uint64_t seed, std::size_t probes) {
  const std::size_t centers_each = share_of(probes, radii_a_centre * meshes.size());
  std::vector<Workload> workloads;
  for (NamedMesh& mesh : meshes) {
    std::vector<Vec3> centers = hard_centers(mesh.mesh, centers_each, seed);
    centers.resize(centers_each);
    std::vector<Step> course = at_the_exact_distance(mesh.mesh, centers);
    workloads.push_back(about(std::move(mesh), "hard centres", std::move(course)));
  }
  return workloads;
}

}  // namespace touchmark::bench
