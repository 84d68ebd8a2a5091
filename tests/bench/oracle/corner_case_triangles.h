/// The program's own corner case triangles and points under the name by which tests know them, and cases made
/// of them.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "bench/experiments/stress/corner_cases.h"

namespace touchmark {

using bench::experiments::stress::CornerCases;

/// For tests that hold for every family.
struct CornerCaseFamily {
  std::string name;
  std::function<CornerCases::Corners(CornerCases&)> triangle;
};

inline void PrintTo(const CornerCaseFamily& family, std::ostream* out) { *out << family.name; }

inline std::vector<CornerCaseFamily> corner_case_families() {
  return {{"needles", &CornerCases::needle},
          {"caps", &CornerCases::cap},
          {"nearly_none", &CornerCases::nearly_none},
          {"mixed_sides", &CornerCases::mixed},
          {"collinear", &CornerCases::collinear},
          {"coincident", &CornerCases::coincident},
          {"plain", &CornerCases::plain},
          {"lattice", &CornerCases::on_lattice}};
}

/// A triangle and a point to ask about.
struct CornerCase {
  CornerCases::Corners triangle;
  Vec3 point;

  /// Returns the largest difference between the point's coordinates and the corners'.
  double largest_difference() const {
    double largest = 0;
    for (const Vec3& v : triangle) largest = std::max(largest, (v - point).cwiseAbs().maxCoeff());
    return largest;
  }
  std::array<Vec3*, 4> vectors() { return {&triangle[0], &triangle[1], &triangle[2], &point}; }
};

/// The point over or about the triangle, both as they are, at a scale from 1e-9 to 1e9, or offset by up to
/// 1e9.
inline CornerCase placed(const CornerCaseFamily& family, CornerCases& cases, int i) {
  CornerCase c{family.triangle(cases), Vec3::Zero()};
  c.point = i % 3 == 0 ? cases.point_above(c.triangle) : cases.point_near(c.triangle);
  const double scale = i % 4 == 1 ? cases.magnitude(-9, 9) : 1;
  const Vec3 offset = i % 4 == 2 ? Vec3(cases.magnitude(0, 9) * cases.vector()) : Vec3::Zero();
  for (Vec3* v : c.vectors()) *v = scale * *v + offset;
  return c;
}

}  // namespace touchmark
