/// Sweeps about a mesh, each with the least radius with which it hits, with one an ulp to a side of it, or
/// with that of its start: past the surface, through it, along it, from a hair beside it, nowhere.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/experiments/stress/corner_cases.h"
#include "bench/oracle/oracle.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::stress {

/// Returns the least radius with which the sweep hits, by halving between doubles.
inline double min_radius(const oracle::Oracle& oracle, const Vec3& from, const Vec3& to) {
  double high = oracle.solve(from).high;
  if (!std::isfinite(high) || !oracle.segment_within(from, to, high))
    high = std::nextafter(high, std::numeric_limits<double>::infinity());
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
inline Vec3 nudged(Vec3 point, CornerCases& cases) {
  double& x = point[static_cast<Eigen::Index>(cases.below(3))];
  const std::uint64_t choice = cases.below(3);
  if (choice > 0)
    x = std::nextafter(
        x, choice == 1 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity());
  return point;
}

/// Makes one mesh's corner case sweeps, seeded. Each is two steps: where it starts, and where it ends with
/// its radius. The sweeps between them are as good as any.
class CornerCaseSweeps {
 public:
  CornerCaseSweeps(const TriangleMesh& mesh, std::uint64_t seed)
      : mesh_(mesh), oracle_(mesh, 1), cases_(seed) {}

  std::vector<workload::Step> trace(std::size_t sweeps) {
    std::vector<workload::Step> steps;
    while (steps.size() < sweeps) add(steps);
    return steps;
  }

 private:
  /// A point of a triangle, its border or its corners, but for rounding.
  Vec3 on_a_triangle() {
    const std::size_t t = cases_.below(mesh_.size());
    const Vec3 &a = mesh_.corner(t, 0), &b = mesh_.corner(t, 1), &c = mesh_.corner(t, 2);
    switch (cases_.below(4)) {
      case 0:
        return a;
      case 1:
        return a + cases_.fraction() * (b - a);
      default:
        return support::point_in_triangle(a, b, c, cases_.fraction(), cases_.fraction());
    }
  }
  double size() const { return mesh_.diagonal(); }
  Vec3 aside(double low, double high) { return cases_.magnitude(low, high) * size() * cases_.vector(); }

  void add(std::vector<workload::Step>& steps) {
    const Vec3 center = on_a_triangle() + aside(-6, 0.5);
    Vec3 from = center, to = center;
    switch (cases_.below(6)) {
      case 0:  // past the surface, at any distance
        to = center + aside(-3, 0.3);
        break;
      case 1:  // along a triangle's plane, or as nearly as doubles go
        from = on_a_triangle();
        to = from + cases_.between(-2, 2) * (on_a_triangle() - from);
        break;
      case 2:  // through a point of the surface, or an ulp beside it
        from = on_a_triangle() + aside(-6, 0);
        to = cases_.below(2) == 0 ? nudged(on_a_triangle(), cases_)
                                  : Vec3(from + 2 * (on_a_triangle() - from));
        break;
      case 3:  // from a hair beside the surface
        from = nudged(on_a_triangle(), cases_);
        to = from + aside(-9, 0);
        break;
      case 4:  // nowhere
        break;
      default:  // parallel to an edge, as nearly as doubles go
        const std::size_t t = cases_.below(mesh_.size());
        from = on_a_triangle() + aside(-3, -1);
        to = from + (mesh_.corner(t, 1) - mesh_.corner(t, 0));
    }
    steps.push_back({{from, 0}, 0});
    const double radius = radius_of(from, to);
    steps.push_back({{to, radius}, radius});
  }

  double radius_of(const Vec3& from, const Vec3& to) {
    const std::uint64_t kind = cases_.below(10);
    if (kind == 0) return 0;
    if (kind < 4) {  // of the start, too
      const double distance = oracle_.solve(from).high;
      if (std::isfinite(distance)) return nudged_radius(distance);
    }
    if (kind < 8) return nudged_radius(min_radius(oracle_, from, to));
    return cases_.magnitude(-4, 0) * size();
  }
  double nudged_radius(double radius) {
    const std::uint64_t choice = cases_.below(3);
    if (choice == 0 || (choice == 1 && radius == 0)) return radius;
    return std::nextafter(radius, choice == 1 ? 0.0 : std::numeric_limits<double>::infinity());
  }

  const TriangleMesh& mesh_;
  oracle::Oracle oracle_;
  CornerCases cases_;
};

}  // namespace touchmark::bench::experiments::stress
