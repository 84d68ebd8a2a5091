#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bench/experiments/stress/corner_case_centers.h"
#include "bench/experiments/stress/corner_cases.h"
#include "bench/experiments/stress/makers.h"
#include "bench/experiments/stress/questions.h"
#include "bench/meshes/generated_meshes.h"
#include "core/float_limits.h"

namespace touchmark::bench::experiments::stress {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double least = std::numeric_limits<double>::denorm_min();
constexpr double largest = std::numeric_limits<double>::max();

/// Few, since every comparison whose squares overflow takes integers of thousands of bits: milliseconds.
constexpr std::size_t max_beyond_squares = 40;

/// One of a list.
template <std::size_t N>
double one_of(const double (&values)[N], CornerCases& cases) {
  return values[cases.below(N)];
}

std::vector<workload::Step> far_and_large(std::size_t count, CornerCases& cases) {
  std::vector<workload::Step> trace;
  while (trace.size() < count) {
    const Vec3 center = cases.magnitude(150, 307) * cases.vector();
    trace.push_back(asked(center, one_of({0, 1, 1e150, 1e300, largest, infinity}, cases)));
    trace.push_back({{cases.vector(), one_of({1e12, 1e100, 1e300, largest, infinity}, cases)}, infinity});
  }
  return trace;
}

}  // namespace

std::vector<workload::Workload> huge(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  const TriangleMesh mesh = meshes::icosphere(1);
  std::vector<Vec3> far;
  while (far.size() < share_of(probes, 6)) far.emplace_back(cases.magnitude(3, 150) * cases.vector());
  std::vector<workload::Step> thresholds = at_the_exact_distance(mesh, far);
  return {
      workload_on({"icosphere:1", mesh}, "at the exact distance, 1e3 to 1e150 away", std::move(thresholds)),
      workload_on({"icosphere:1", mesh}, "anywhere, any radius",
                  far_and_large(std::min(share_of(probes, 2), max_beyond_squares), cases))};
}

std::vector<workload::Workload> denormal(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  const std::size_t each = share_of(probes, 3);
  std::vector<CornerCases::Corners> triangles;
  for (int i = 0; i < 40; ++i) triangles.push_back(cases.on_lattice());
  TriangleMesh mesh = mesh_of(triangles);
  std::vector<workload::Step> trace;
  while (trace.size() < each) {
    const Vec3 tiny = cases.magnitude(-323, -300) * cases.vector();
    const Vec3 on = cases.below(2) == 0 ? Vec3::Zero() : mesh.corner(cases.below(mesh.size()), 0);
    trace.push_back(asked(on + tiny, one_of({0, least, 4 * least, 1e-310, 1e-300}, cases)));
  }
  std::vector<workload::Workload> workloads;
  // Lengths whose squares are zero, and coordinates that are themselves denormal.
  for (const double scale : {0x1p-560, 0x1p-1060}) {
    TriangleMesh small = mesh.transformed(scale, Vec3::Zero());
    std::vector<Vec3> centers;
    while (centers.size() < share_of(each, 3)) centers.emplace_back(scale * 4 * cases.lattice());
    std::vector<workload::Step> thresholds = at_the_exact_distance(small, centers);
    workloads.push_back(
        workload_on({scale > 0x1p-600 ? "lattice@scale=2^-560" : "lattice@scale=2^-1060", std::move(small)},
                    "at the exact distance", std::move(thresholds)));
  }
  workloads.push_back(
      workload_on({"lattice triangles", std::move(mesh)}, "denormal centres and radii", std::move(trace)));
  return workloads;
}

std::vector<workload::Workload> not_a_number(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  std::vector<workload::Step> centers, radii;
  while (centers.size() < share_of(probes, 2)) {
    Vec3 center = cases.vector();
    center[static_cast<Eigen::Index>(cases.below(3))] = one_of({nan, infinity, -infinity}, cases);
    centers.push_back(asked(center, one_of({0, 0.1, 10, largest}, cases)));
  }
  while (radii.size() < share_of(probes, 2)) {
    const workload::Step step{{2 * cases.vector(), one_of({nan, -1, -least, -infinity, -0.0}, cases)}, 0};
    radii.push_back({step.probe, step.probe.radius});
  }
  return {workload_on({"icosphere:1", meshes::icosphere(1)}, "centres", std::move(centers)),
          workload_on({"icosphere:1", meshes::icosphere(1)}, "radii", std::move(radii))};
}

}  // namespace touchmark::bench::experiments::stress
