/// Ways about a mesh, each with the least radius with which it hits, with one an ulp to a side of it, or with
/// that of its start: past the surface, through it, along it, from a hair beside it, nowhere.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/experiments/stress/hard_cases.h"
#include "bench/oracle/oracle.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench {

/// The least radius with which the way hits, by halving between doubles.
inline double least_radius(const Oracle& oracle, const Vec3& from, const Vec3& to) {
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
inline Vec3 nudged(Vec3 point, HardCases& hard) {
  double& x = point[static_cast<Eigen::Index>(hard.below(3))];
  const std::uint64_t way = hard.below(3);
  if (way > 0)
    x = std::nextafter(
        x, way == 1 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity());
  return point;
}

/// One mesh's hard ways, seeded. Each is two steps: where it starts, and where it ends with its radius. The
/// sweeps between them are as good as any.
class HardWays {
 public:
  HardWays(const TriangleMesh& mesh, std::uint64_t seed) : mesh_(mesh), oracle_(mesh, 1), hard_(seed) {}

  std::vector<Step> course(std::size_t sweeps) {
    std::vector<Step> steps;
    while (steps.size() < sweeps) add(steps);
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

  void add(std::vector<Step>& steps) {
    const Vec3 center = on_a_triangle() + aside(-6, 0.5);
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
    steps.push_back({{from, 0}, 0});
    const double radius = radius_of(from, to);
    steps.push_back({{to, radius}, radius});
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
    return std::nextafter(radius, way == 1 ? 0.0 : std::numeric_limits<double>::infinity());
  }

  const TriangleMesh& mesh_;
  Oracle oracle_;
  HardCases hard_;
};

}  // namespace touchmark::bench
