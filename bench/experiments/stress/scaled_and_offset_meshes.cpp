#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/stress/corner_cases.h"
#include "bench/experiments/stress/makers.h"
#include "bench/experiments/stress/questions.h"
#include "bench/meshes/generated_meshes.h"

namespace touchmark::bench::experiments::stress {
namespace {

constexpr std::size_t triangles_moved = 200;

}  // namespace

std::vector<workload::Workload> thresholds(std::uint64_t seed, std::size_t probes) {
  return corner_case_questions({{"icosphere", meshes::icosphere(2)},
                                {"torus", meshes::torus(24, 12)},
                                {"noisy-sphere", meshes::noisy_sphere(400)},
                                {"soup", meshes::soup(300)},
                                {"wedge", meshes::wedge()}},
                               seed, probes);
}

std::vector<workload::Workload> scales(std::uint64_t seed, std::size_t probes) {
  std::vector<NamedMesh> meshes;
  const TriangleMesh mesh = meshes::soup(triangles_moved);
  // To both ends of the range of double, and on both sides of where squares and fourth powers leave it.
  for (const double scale : {1e-300, 1e-150, 1e-90, 1e-60, 1e-39, 1e-20, 1e-9, 1e-3, 1e3, 1e9, 1e20, 1e38,
                             1e60, 1e90, 1e150, 1e300})
    meshes.push_back({fmt::format("soup@scale={:g}", scale), mesh.transformed(scale, Vec3::Zero())});
  return corner_case_questions(std::move(meshes), seed, probes);
}

std::vector<workload::Workload> offsets(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  std::vector<NamedMesh> meshes;
  const auto add = [&](const char* name, const TriangleMesh& mesh, int exponent) {
    // By that many of its longest side along one axis, and by any part of them along the others.
    Vec3 position = cases.vector();
    position[static_cast<int>(cases.below(3))] = cases.below(2) == 0 ? -1 : 1;
    const double offset = std::ldexp(mesh.bounds().extent().maxCoeff(), exponent);
    meshes.push_back(
        {fmt::format("{} moved by 2^{}", name, exponent), mesh.transformed(1, offset * position)});
  };
  // Up to where a mesh is a few doubles wide.
  for (const int exponent : {10, 20, 28, 31, 34, 38, 42, 46, 50}) {
    add("soup", meshes::soup(triangles_moved), exponent);
    add("torus", meshes::torus(12, 8), exponent);
  }
  return corner_case_questions(std::move(meshes), seed, probes);
}

std::vector<workload::Workload> ball_centre(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  std::vector<workload::Workload> workloads;
  for (const unsigned levels : {0U, 1U, 2U}) {
    const TriangleMesh mesh = meshes::icosphere(levels);
    std::vector<Vec3> centers{Vec3::Zero()};
    while (centers.size() < share_of(probes, 9))
      centers.emplace_back(cases.magnitude(-18, -2) * cases.vector());
    std::vector<workload::Step> trace = at_the_exact_distance(mesh, centers);
    workloads.push_back(
        workload_on({fmt::format("icosphere:{}", levels), mesh}, "about the middle", std::move(trace)));
  }
  return workloads;
}

}  // namespace touchmark::bench::experiments::stress
