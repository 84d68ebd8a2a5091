/// The program's own hard triangles and points under the name by which tests know them, and cases made of
/// them.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "bench/experiments/stress/hard_cases.h"

namespace touchmark {

using bench::HardCases;

/// For tests that hold for every family.
struct HardFamily {
  std::string name;
  std::function<HardCases::Corners(HardCases&)> triangle;
};

inline void PrintTo(const HardFamily& family, std::ostream* out) { *out << family.name; }

inline std::vector<HardFamily> hard_families() {
  return {{"needles", &HardCases::needle},
          {"caps", &HardCases::cap},
          {"nearly_none", &HardCases::nearly_none},
          {"mixed_sides", &HardCases::mixed},
          {"collinear", &HardCases::collinear},
          {"coincident", &HardCases::coincident},
          {"plain", &HardCases::plain},
          {"lattice", &HardCases::on_lattice}};
}

/// A triangle and a point to ask about.
struct HardCase {
  HardCases::Corners triangle;
  Vec3 point;

  /// Of the point's coordinates and the corners'.
  double largest_difference() const {
    double largest = 0;
    for (const Vec3& v : triangle) largest = std::max(largest, (v - point).cwiseAbs().maxCoeff());
    return largest;
  }
  std::array<Vec3*, 4> vectors() { return {&triangle[0], &triangle[1], &triangle[2], &point}; }
};

/// The point over or about the triangle, both as they are, at a scale from 1e-9 to 1e9, or offset by up to
/// 1e9.
inline HardCase placed(const HardFamily& family, HardCases& hard, int i) {
  HardCase c{family.triangle(hard), Vec3::Zero()};
  c.point = i % 3 == 0 ? hard.point_over(c.triangle) : hard.point_about(c.triangle);
  const double scale = i % 4 == 1 ? hard.magnitude(-9, 9) : 1;
  const Vec3 offset = i % 4 == 2 ? Vec3(hard.magnitude(0, 9) * hard.vector()) : Vec3::Zero();
  for (Vec3* v : c.vectors()) *v = scale * *v + offset;
  return c;
}

}  // namespace touchmark
