// Ways, each with the radius at which it begins to hit, or one ulp to a side of it. A step's sweep comes from
// the step before, so a course is a list of pairs: where a way starts and where it ends. The sweeps between
// them are asked as well, and are as good as any.
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/generated_scenes.h"
#include "bench/oracle/oracle.h"
#include "bench/stress/hard_cases.h"
#include "bench/stress/hard_centers.h"
#include "bench/stress/makers.h"
#include "bench/stress/questions.h"

namespace touchmark::bench::stress {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The least radius with which the way hits, by halving between doubles.
double least_radius(const Oracle& oracle, const Vec3& from, const Vec3& to) {
  double high = oracle.solve(from).high;
  if (!std::isfinite(high) || !oracle.segment_within(from, to, high)) high = std::nextafter(high, infinity);
  if (!std::isfinite(high) || oracle.segment_within(from, to, 0)) return 0;
  double low = 0;
  for (int step = 0; step < 1200; ++step) {
    // Halving the exponent first: a radius may be far below the start's distance.
    const double middle = low < 0x1p-30 * high ? 0x1p-15 * high : low + (high - low) / 2;
    if (!(middle > low && middle < high)) break;
    (oracle.segment_within(from, to, middle) ? high : low) = middle;
  }
  return high;
}

/// One coordinate moved by one ulp, up or down, or none.
Vec3 nudged(Vec3 point, HardCases& hard) {
  double& x = point[static_cast<Eigen::Index>(hard.below(3))];
  const std::uint64_t way = hard.below(3);
  if (way > 0) x = std::nextafter(x, way == 1 ? infinity : -infinity);
  return point;
}

class Ways {
 public:
  Ways(const TriangleMesh& mesh, std::uint64_t seed) : mesh_(mesh), oracle_(mesh, 1), hard_(seed) {}

  std::vector<Step> course(std::size_t sweeps) {
    std::vector<Vec3> centers = hard_centers(mesh_, 2 * sweeps + 2, hard_.below(1 << 30));
    std::vector<Step> steps;
    // The first hard centres are far away and many to one; others are about the surface.
    for (std::size_t i = 14; steps.size() < sweeps; i = i + 1 < centers.size() ? i + 1 : 14)
      add(centers[i], steps);
    return steps;
  }

 private:
  /// A point of a triangle, its border or its corners, but for rounding.
  Vec3 on_a_triangle() {
    const std::size_t t = hard_.below(mesh_.size());
    const Vec3 &a = mesh_.corner(t, 0), &b = mesh_.corner(t, 1), &c = mesh_.corner(t, 2);
    switch (hard_.below(4)) {
      case 0:
        return a;
      case 1:
        return a + hard_.fraction() * (b - a);
      default:
        return place_in_triangle(a, b, c, hard_.fraction(), hard_.fraction());
    }
  }
  double size() const { return mesh_.diagonal(); }
  Vec3 aside(double low, double high) { return hard_.magnitude(low, high) * size() * hard_.vector(); }

  void add(const Vec3& center, std::vector<Step>& steps) {
    Vec3 from = center, to = center;
    switch (hard_.below(6)) {
      case 0:  // past the surface, at any distance
        to = center + aside(-3, 0.3);
        break;
      case 1:  // along a triangle's plane, or as nearly as doubles go
        from = on_a_triangle();
        to = from + hard_.between(-2, 2) * (on_a_triangle() - from);
        break;
      case 2:  // through a point of the surface, or an ulp beside it
        from = on_a_triangle() + aside(-6, 0);
        to = hard_.below(2) == 0 ? nudged(on_a_triangle(), hard_) : Vec3(from + 2 * (on_a_triangle() - from));
        break;
      case 3:  // from a hair beside the surface
        from = nudged(on_a_triangle(), hard_);
        to = from + aside(-9, 0);
        break;
      case 4:  // nowhere
        break;
      default:  // parallel to an edge, as nearly as doubles go
        const std::size_t t = hard_.below(mesh_.size());
        from = on_a_triangle() + aside(-3, -1);
        to = from + (mesh_.corner(t, 1) - mesh_.corner(t, 0));
    }
    steps.push_back(asked(from, 0));
    steps.push_back(asked(to, radius_of(from, to)));
  }

  double radius_of(const Vec3& from, const Vec3& to) {
    const std::uint64_t kind = hard_.below(10);
    if (kind == 0) return 0;
    if (kind < 4) {  // of the start, too
      const double distance = oracle_.solve(from).high;
      if (std::isfinite(distance)) return beside(distance);
    }
    if (kind < 8) return beside(least_radius(oracle_, from, to));
    return hard_.magnitude(-4, 0) * size();
  }
  double beside(double radius) {
    const std::uint64_t way = hard_.below(3);
    if (way == 0 || (way == 1 && radius == 0)) return radius;
    return std::nextafter(radius, way == 1 ? 0.0 : infinity);
  }

  const TriangleMesh& mesh_;
  Oracle oracle_;
  HardCases hard_;
};

std::vector<Workload> ways_about(std::vector<NamedMesh> meshes, std::uint64_t seed, std::size_t probes) {
  const std::size_t each = share_of(probes, meshes.size());
  std::vector<Workload> workloads;
  for (NamedMesh& mesh : meshes) {
    std::vector<Step> course = Ways(mesh.mesh, seed).course(each);
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
                     {"degenerate", degenerate()}},
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
