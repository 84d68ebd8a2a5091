/// Triangles and points that break distance code, seeded: needles, caps, collinear and coincident corners,
/// far offsets, tiny and huge scales, and points placed on and just off every feature.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "bench/support/random.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::stress {

class CornerCases : public support::Random {
 public:
  using Corners = std::array<Vec3, 3>;
  using support::Random::Random;

  /// In [0, 1).
  double fraction() { return unit(); }
  /// 10^e for e uniform in [low, high].
  double magnitude(double low, double high) { return std::pow(10.0, between(low, high)); }
  Vec3 vector() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
  /// Small whole numbers, so that exact ties, right angles and collinear corners are common.
  Vec3 lattice() { return {whole(), whole(), whole()}; }

  /// A short side against two long ones, aspect up to 1e15.
  Corners needle() {
    const Vec3 a = vector(), b = vector();
    return shuffled({a, b, b + magnitude(-15, -1) * vector()});
  }
  /// Three corners nearly on a line, the middle one anywhere between, aspect up to 1e15.
  Corners cap() {
    const Vec3 a = vector(), b = vector();
    return shuffled({a, b, a + fraction() * (b - a) + magnitude(-15, -1) * vector()});
  }
  /// As thin as coordinates can tell: the third corner within a few roundings of the line, or on it.
  Corners nearly_none() {
    const Vec3 a = vector(), direction = vector();
    const Vec3 aside = (vector() - vector()).norm() * Vec3(-direction.y(), direction.x(), 0);
    return shuffled({a, a + direction, a + fraction() * direction + magnitude(-17, -12) * aside});
  }
  /// Sides of very different lengths.
  Corners mixed() {
    const Vec3 a = vector();
    return shuffled({a, a + magnitude(-8, 0) * vector(), a + magnitude(-8, 0) * vector()});
  }
  Corners collinear() {
    const Vec3 a = lattice(), direction = lattice();
    return shuffled({a, a + whole() * direction, a + whole() * direction});
  }
  Corners coincident() {
    const Vec3 a = vector();
    return shuffled({a, a, below(2) == 0 ? a : vector()});
  }
  Corners plain() { return {vector(), vector(), vector()}; }
  Corners on_lattice() { return {lattice(), lattice(), lattice()}; }

  /// Anywhere near, on, just off, over or far away from the triangle.
  Vec3 point_near(const Corners& t) {
    const double size = std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm(),
                                  1e-12});  // of a point: some size to place others about it
    double a = fraction(), b = fraction();
    switch (below(5)) {
      case 0:
        a = b = 0;  // a corner
        break;
      case 1:
        b = 0;  // an edge
        break;
      case 2:
        b = 1 - a;  // another
        break;
      default:  // anywhere
        break;
    }
    const std::size_t first = below(3);
    const Vec3 on = support::point_in_triangle(t[first], t[(first + 1) % 3], t[(first + 2) % 3], a, b);
    switch (below(4)) {
      case 0:
        return on;
      case 1:
        return on + size * magnitude(-17, 0) * vector();
      case 2:
        return on + size * 2 * vector();
      default:
        return on + size * magnitude(0, 6) * vector();
    }
  }

  /// Over the face or its border, from a hair's breadth to ten times the size above it; anywhere near when
  /// there is no face.
  Vec3 point_above(const Corners& t) {
    const Vec3 e = t[1] - t[0], f = t[2] - t[0];
    const Vec3 normal(e.y() * f.z() - e.z() * f.y(), e.z() * f.x() - e.x() * f.z(),
                      e.x() * f.y() - e.y() * f.x());
    const double length = normal.norm();
    if (!(length > 0)) return point_near(t);
    const double a = fraction(), b = below(3) == 0 ? 0 : fraction();
    return support::point_in_triangle(t[0], t[1], t[2], a, b) + (magnitude(-17, 1) / length) * normal;
  }

  Corners shuffled(Corners t) {
    std::swap(t[0], t[below(3)]);
    std::swap(t[1], t[1 + below(2)]);
    return t;
  }

 private:
  double whole() { return static_cast<double>(below(7)) - 3; }
};

/// These triangles with corners of their own.
inline TriangleMesh mesh_of(const std::vector<CornerCases::Corners>& triangles,
                            std::vector<TriangleId> ids = {}) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> corners;
  for (const CornerCases::Corners& t : triangles) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), t.begin(), t.end());
    corners.push_back({first, first + 1, first + 2});
  }
  return {std::move(vertices), std::move(corners), std::move(ids)};
}

}  // namespace touchmark::bench::experiments::stress
