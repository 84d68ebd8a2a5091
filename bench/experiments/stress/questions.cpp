#include "bench/experiments/stress/questions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/experiments/stress/corner_case_centers.h"
#include "bench/oracle/oracle.h"
#include "core/float_limits.h"

namespace touchmark::bench::experiments::stress {
namespace {

constexpr std::size_t radii_a_centre = 3;

}  // namespace

std::vector<workload::Step> at_the_exact_distance(const TriangleMesh& mesh,
                                                  const std::vector<Vec3>& centers) {
  std::vector<Probe> probes;
  for (const Vec3& center : centers) probes.push_back({center, 0});
  const std::vector<oracle::GroundTruth> truths = oracle::Oracle(mesh).solve(probes);
  std::vector<workload::Step> trace;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const double distance = truths[i].high;
    if (!truths[i].defined || !std::isfinite(distance)) continue;
    if (distance > 0) trace.push_back(asked(centers[i], std::nextafter(distance, 0)));
    trace.push_back(asked(centers[i], distance));
    trace.push_back(asked(centers[i], std::nextafter(distance, infinity)));
  }
  return trace;
}

workload::Workload workload_on(NamedMesh mesh, std::string trace_name, std::vector<workload::Step> trace) {
  return {std::move(mesh.name), std::move(mesh.mesh), 0, {}, {std::move(trace_name)}, {std::move(trace)}};
}

std::size_t share_of(std::size_t probes, std::size_t parts) {
  return std::max<std::size_t>(probes / parts, 1);
}

std::vector<workload::Workload> corner_case_questions(std::vector<NamedMesh> meshes, std::uint64_t seed,
                                                      std::size_t probes) {
  const std::size_t centers_each = share_of(probes, radii_a_centre * meshes.size());
  std::vector<workload::Workload> workloads;
  for (NamedMesh& mesh : meshes) {
    std::vector<Vec3> centers = corner_case_centers(mesh.mesh, centers_each, seed);
    centers.resize(centers_each);
    std::vector<workload::Step> trace = at_the_exact_distance(mesh.mesh, centers);
    workloads.push_back(workload_on(std::move(mesh), "hard centres", std::move(trace)));
  }
  return workloads;
}

}  // namespace touchmark::bench::experiments::stress
