// Sweeps, each with the radius at which it begins to hit, or one ulp to a side of it. A step's sweep comes
// from the step before, so a trace is a list of pairs: where a sweep starts and where it ends.
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/stress/corner_case_sweeps.h"
#include "bench/experiments/stress/corner_cases.h"
#include "bench/experiments/stress/makers.h"
#include "bench/experiments/stress/questions.h"
#include "bench/meshes/generated_meshes.h"

namespace touchmark::bench::experiments::stress {
namespace {

std::vector<workload::Workload> sweeps_on(std::vector<NamedMesh> meshes, std::uint64_t seed,
                                          std::size_t probes) {
  const std::size_t each = share_of(probes, meshes.size());
  std::vector<workload::Workload> workloads;
  for (NamedMesh& mesh : meshes) {
    std::vector<workload::Step> trace = CornerCaseSweeps(mesh.mesh, seed).trace(each);
    workloads.push_back(workload_on(std::move(mesh), "ways", std::move(trace)));
  }
  return workloads;
}

}  // namespace

std::vector<workload::Workload> sweeps(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  std::vector<CornerCases::Corners> thin, whole;
  for (int i = 0; i < 60; ++i) thin.push_back(i % 2 == 0 ? cases.needle() : cases.cap());
  for (int i = 0; i < 60; ++i) whole.push_back(cases.on_lattice());
  return sweeps_on({{"icosphere", meshes::icosphere(2)},
                    {"noisy-sphere", meshes::noisy_sphere(400)},
                    {"cube", meshes::cube()},
                    {"soup", meshes::soup(200)},
                    {"needles and caps", mesh_of(thin)},
                    {"whole numbers", mesh_of(whole)},
                    {"degenerate", meshes::degenerate()}},
                   seed, probes);
}

std::vector<workload::Workload> far_sweeps(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  std::vector<NamedMesh> meshes;
  for (const int exponent : {34, 42, 48, 50}) {
    meshes.push_back({fmt::format("icosphere moved by 2^{}", exponent),
                      meshes::icosphere(2).transformed(1, std::ldexp(1.0, exponent) * cases.vector())});
    meshes.push_back({fmt::format("soup moved by 2^{}", exponent),
                      meshes::soup(100).transformed(1, std::ldexp(1.0, exponent) * cases.vector())});
  }
  for (const int exponent : {-1020, -500, -140, -70, 70, 140, 500, 1000})
    meshes.push_back({fmt::format("soup@scale=2^{}", exponent),
                      meshes::soup(60).transformed(std::ldexp(1.0, exponent), Vec3::Zero())});
  return sweeps_on(std::move(meshes), seed, probes);
}

}  // namespace touchmark::bench::experiments::stress
