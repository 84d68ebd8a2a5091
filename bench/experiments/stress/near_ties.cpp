#include "bench/experiments/stress/near_ties.h"

#include <utility>

#include "bench/experiments/stress/makers.h"
#include "bench/experiments/stress/questions.h"
#include "bench/meshes/generated_meshes.h"

namespace touchmark::bench::experiments::stress {
namespace {

/// A reach of twice the distance, so that it is not the reach that makes a search look closer.
std::vector<workload::Step> well_within_reach(const oracle::Oracle& oracle,
                                              const std::vector<Vec3>& centers) {
  std::vector<workload::Step> trace;
  for (const Vec3& center : centers) trace.push_back(asked(center, 2 * oracle.solve(center).high));
  return trace;
}

workload::Workload turned(CornerCases& cases, std::size_t probes) {
  TriangleMesh mesh = turned_images(cases, 12);
  std::vector<Vec3> centers;
  while (centers.size() < probes) centers.push_back(on_the_diagonal(cases));
  std::vector<workload::Step> trace = well_within_reach(oracle::Oracle(mesh), centers);
  return workload_on({"turned images", std::move(mesh)}, "on the axis of turning", std::move(trace));
}

/// `length`: how far apart the ends are between which the nearest changes, at most.
workload::Workload between(NamedMesh named, CornerCases& cases, double length, std::size_t probes) {
  const oracle::Oracle oracle(named.mesh);
  std::vector<Vec3> centers;
  const double size = 0.5 * named.mesh.diagonal();
  while (centers.size() < probes) {
    const Vec3 from = named.mesh.bounds().center() + cases.magnitude(-2, 0.5) * size * cases.vector();
    const Vec3 position = where_the_nearest_changes(oracle, from, from + length * size * cases.vector());
    for (const Vec3& neighbour : with_neighbors(position, cases))
      if (centers.size() < probes) centers.push_back(neighbour);
  }
  std::vector<workload::Step> trace = well_within_reach(oracle, centers);
  return workload_on(std::move(named), "where the nearest changes", std::move(trace));
}

}  // namespace

std::vector<workload::Workload> near_ties(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  const std::size_t each = share_of(probes, 4);
  std::vector<CornerCases::Corners> soup;
  for (int i = 0; i < 80; ++i) soup.push_back(i % 4 == 0 ? cases.needle() : cases.plain());
  std::vector<workload::Workload> workloads;
  workloads.push_back(turned(cases, each));
  workloads.push_back(turned(cases, each));
  workloads.push_back(between({"needles and others", mesh_of(soup)}, cases, 0.5, each));
  workloads.push_back(between({"icosphere", meshes::icosphere(2)}, cases, 0.2, each));
  return workloads;
}

}  // namespace touchmark::bench::experiments::stress
