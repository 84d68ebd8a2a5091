#include <utility>

#include <fmt/format.h>

#include "bench/generated_scenes.h"
#include "bench/stress/hard_cases.h"
#include "bench/stress/makers.h"
#include "bench/stress/questions.h"

namespace touchmark::bench::stress {
namespace {

constexpr std::size_t triangles_moved = 200;

}  // namespace

std::vector<Workload> thresholds(std::uint64_t seed, std::size_t probes) {
  return hard_questions({{"icosphere", icosphere(2)},
                         {"torus", torus(24, 12)},
                         {"noisy-sphere", noisy_sphere(400)},
                         {"soup", soup(300)},
                         {"wedge", wedge()}},
                        seed, probes);
}

std::vector<Workload> scales(std::uint64_t seed, std::size_t probes) {
  std::vector<NamedMesh> meshes;
  const TriangleMesh mesh = soup(triangles_moved);
  for (const double scale : {1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9})
    meshes.push_back({fmt::format("soup@scale={:g}", scale), mesh.transformed(scale, Vec3::Zero())});
  return hard_questions(std::move(meshes), seed, probes);
}

std::vector<Workload> offsets(std::uint64_t seed, std::size_t probes) {
  HardCases hard(seed);
  std::vector<NamedMesh> meshes;
  for (const double offset : {1e3, 1e6, 1e9}) {
    meshes.push_back({fmt::format("soup moved by {:g}", offset),
                      soup(triangles_moved).transformed(1, offset * hard.vector())});
    meshes.push_back(
        {fmt::format("torus moved by {:g}", offset), torus(12, 8).transformed(1, offset * hard.vector())});
  }
  return hard_questions(std::move(meshes), seed, probes);
}

std::vector<Workload> ball_centre(std::uint64_t seed, std::size_t probes) {
  HardCases hard(seed);
  std::vector<Workload> workloads;
  for (const unsigned levels : {0U, 1U, 2U}) {
    const TriangleMesh mesh = icosphere(levels);
    std::vector<Vec3> centers{Vec3::Zero()};
    while (centers.size() < share_of(probes, 9))
      centers.emplace_back(hard.magnitude(-18, -2) * hard.vector());
    std::vector<Step> course = at_the_exact_distance(mesh, centers);
    workloads.push_back(
        about({fmt::format("icosphere:{}", levels), mesh}, "about the middle", std::move(course)));
  }
  return workloads;
}

}  // namespace touchmark::bench::stress
