#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bench/experiments/stress/hard_cases.h"
#include "bench/experiments/stress/hard_centers.h"
#include "bench/experiments/stress/makers.h"
#include "bench/experiments/stress/questions.h"
#include "bench/scenes/generated_scenes.h"

namespace touchmark::bench::stress {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double least = std::numeric_limits<double>::denorm_min();
constexpr double largest = std::numeric_limits<double>::max();

/// Where squares overflow every comparison takes whole numbers of thousands of bits: milliseconds.
constexpr std::size_t most_beyond_squares = 40;

/// One of a list.
template <std::size_t N>
double one_of(const double (&values)[N], HardCases& hard) {
  return values[hard.below(N)];
}

std::vector<Step> far_and_large(std::size_t count, HardCases& hard) {
  std::vector<Step> course;
  while (course.size() < count) {
    const Vec3 center = hard.magnitude(150, 307) * hard.vector();
    course.push_back(asked(center, one_of({0, 1, 1e150, 1e300, largest, infinity}, hard)));
    course.push_back({{hard.vector(), one_of({1e12, 1e100, 1e300, largest, infinity}, hard)}, infinity});
  }
  return course;
}

}  // namespace

std::vector<Workload> huge(std::uint64_t seed, std::size_t probes) {
  HardCases hard(seed);
  const TriangleMesh mesh = icosphere(1);
  std::vector<Vec3> far;
  while (far.size() < share_of(probes, 6)) far.emplace_back(hard.magnitude(3, 150) * hard.vector());
  std::vector<Step> thresholds = at_the_exact_distance(mesh, far);
  return {about({"icosphere:1", mesh}, "at the exact distance, 1e3 to 1e150 away", std::move(thresholds)),
          about({"icosphere:1", mesh}, "anywhere, any radius",
                far_and_large(std::min(share_of(probes, 2), most_beyond_squares), hard))};
}

std::vector<Workload> denormal(std::uint64_t seed, std::size_t probes) {
  HardCases hard(seed);
  const std::size_t each = share_of(probes, 3);
  std::vector<HardCases::Corners> triangles;
  for (int i = 0; i < 40; ++i) triangles.push_back(hard.on_lattice());
  TriangleMesh mesh = mesh_of(triangles);
  std::vector<Step> course;
  while (course.size() < each) {
    const Vec3 tiny = hard.magnitude(-323, -300) * hard.vector();
    const Vec3 on = hard.below(2) == 0 ? Vec3::Zero() : mesh.corner(hard.below(mesh.size()), 0);
    course.push_back(asked(on + tiny, one_of({0, least, 4 * least, 1e-310, 1e-300}, hard)));
  }
  std::vector<Workload> workloads;
  // Lengths whose squares are zero, and coordinates that are themselves denormal.
  for (const double scale : {0x1p-560, 0x1p-1060}) {
    TriangleMesh small = mesh.transformed(scale, Vec3::Zero());
    std::vector<Vec3> centers;
    while (centers.size() < share_of(each, 3)) centers.emplace_back(scale * 4 * hard.lattice());
    std::vector<Step> thresholds = at_the_exact_distance(small, centers);
    workloads.push_back(
        about({scale > 0x1p-600 ? "lattice@scale=2^-560" : "lattice@scale=2^-1060", std::move(small)},
              "at the exact distance", std::move(thresholds)));
  }
  workloads.push_back(
      about({"lattice triangles", std::move(mesh)}, "denormal centres and radii", std::move(course)));
  return workloads;
}

std::vector<Workload> not_a_number(std::uint64_t seed, std::size_t probes) {
  HardCases hard(seed);
  std::vector<Step> centers, radii;
  while (centers.size() < share_of(probes, 2)) {
    Vec3 center = hard.vector();
    center[static_cast<Eigen::Index>(hard.below(3))] = one_of({nan, infinity, -infinity}, hard);
    centers.push_back(asked(center, one_of({0, 0.1, 10, largest}, hard)));
  }
  while (radii.size() < share_of(probes, 2)) {
    const Step step{{2 * hard.vector(), one_of({nan, -1, -least, -infinity, -0.0}, hard)}, 0};
    radii.push_back({step.probe, step.probe.radius});
  }
  return {about({"icosphere:1", icosphere(1)}, "centres", std::move(centers)),
          about({"icosphere:1", icosphere(1)}, "radii", std::move(radii))};
}

}  // namespace touchmark::bench::stress
