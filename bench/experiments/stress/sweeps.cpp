// Ways, each with the radius at which it begins to hit, or one ulp to a side of it. A step's sweep comes from
// the step before, so a course is a list of pairs: where a way starts and where it ends.
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/stress/hard_cases.h"
#include "bench/experiments/stress/hard_ways.h"
#include "bench/experiments/stress/makers.h"
#include "bench/experiments/stress/questions.h"
#include "bench/scenes/generated_scenes.h"

namespace touchmark::bench::stress {
namespace {

std::vector<Workload> ways_about(std::vector<NamedMesh> meshes, std::uint64_t seed, std::size_t probes) {
  const std::size_t each = share_of(probes, meshes.size());
  std::vector<Workload> workloads;
  for (NamedMesh& mesh : meshes) {
    std::vector<Step> course = HardWays(mesh.mesh, seed).course(each);
    workloads.push_back(about(std::move(mesh), "ways", std::move(course)));
  }
  return workloads;
}

}  // namespace

std::vector<Workload> sweeps(std::uint64_t seed, std::size_t probes) {
  HardCases hard(seed);
  std::vector<HardCases::Corners> thin, whole;
  for (int i = 0; i < 60; ++i) thin.push_back(i % 2 == 0 ? hard.needle() : hard.cap());
  for (int i = 0; i < 60; ++i) whole.push_back(hard.on_lattice());
  return ways_about({{"icosphere", icosphere(2)},
                     {"noisy-sphere", noisy_sphere(400)},
                     {"cube", cube()},
                     {"soup", soup(200)},
                     {"needles and caps", mesh_of(thin)},
                     {"whole numbers", mesh_of(whole)},
                     {"degenerate", bench::degenerate()}},
                    seed, probes);
}

std::vector<Workload> far_sweeps(std::uint64_t seed, std::size_t probes) {
  HardCases hard(seed);
  std::vector<NamedMesh> meshes;
  for (const int exponent : {34, 42, 48, 50}) {
    meshes.push_back({fmt::format("icosphere moved by 2^{}", exponent),
                      icosphere(2).transformed(1, std::ldexp(1.0, exponent) * hard.vector())});
    meshes.push_back({fmt::format("soup moved by 2^{}", exponent),
                      soup(100).transformed(1, std::ldexp(1.0, exponent) * hard.vector())});
  }
  for (const int exponent : {-1020, -500, -140, -70, 70, 140, 500, 1000})
    meshes.push_back({fmt::format("soup@scale=2^{}", exponent),
                      soup(60).transformed(std::ldexp(1.0, exponent), Vec3::Zero())});
  return ways_about(std::move(meshes), seed, probes);
}

}  // namespace touchmark::bench::stress
