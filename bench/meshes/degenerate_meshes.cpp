// Meshes that break what was written for good triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "bench/meshes/generated_meshes.h"
#include "bench/meshes/portable_sincos.h"
#include "bench/support/random.h"

namespace touchmark::bench::meshes {
namespace {

/// Triangles that share no vertices.
struct Loose {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
  }
  TriangleMesh mesh() && { return {std::move(vertices), std::move(triangles)}; }
};

/// On a lattice of 2^-12, so that midpoints and sums of a few are exact.
Vec3 dyadic_point(support::Random& random) {
  const auto coordinate = [&] { return static_cast<double>(random.below(8193)) / 4096 - 1; };
  const double x = coordinate(), y = coordinate(), z = coordinate();
  return {x, y, z};
}

/// Both extreme families: `apex` says where over a base of length 1 the third corner stands, 0 to 1. The
/// height lies along an axis and everything else in the plane across it, so that heights down to 1e-15
/// survive rounding.
TriangleMesh flat_triangles(double apex) {
  Loose triangles;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 up = Vec3::Unit(axis), right = Vec3::Unit((axis + 1) % 3), ahead = Vec3::Unit((axis + 2) % 3);
    double height = 1;
    for (int power = 0; power <= 15; ++power, height /= 10) {
      for (int heading = 0; heading < 4; ++heading) {
        const SinCos direction = portable_sincos(heading / 4.0 + power / 64.0);
        const Vec3 along = direction.cos * right + direction.sin * ahead;
        const Vec3 start = (power / 8.0 - 1) * right + (heading / 2.0 - 0.75) * ahead;
        const Vec3 tip = start + apex * along + height * up;
        if (heading % 2 == 0) {
          triangles.add(start, start + along, tip);
        } else {
          triangles.add(tip, start + along, start);  // the other way round, another corner first
        }
      }
    }
  }
  return std::move(triangles).mesh();
}

}  // namespace

TriangleMesh sliver_fan() {
  constexpr int slivers = 1000;
  constexpr double ratio = 0.97946966670695346;  // ratio^999 is 1e-9
  std::vector<Vec3> vertices{{0, 0, 0.2}};
  std::vector<TriangleMesh::Corners> triangles;
  double width = 1 - ratio, fraction = 0;  // the widths of all, in turns, sum to one but for 1e-9
  for (int i = 0; i <= slivers; ++i) {
    const SinCos rim = portable_sincos(fraction);
    vertices.emplace_back(rim.cos, rim.sin, 0);
    if (i > 0) triangles.push_back({0, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i + 1)});
    fraction += width;
    width *= ratio;
  }
  return {std::move(vertices), std::move(triangles)};
}

TriangleMesh soup(std::uint64_t triangles) {
  support::Random random(20170817);
  Loose loose;
  loose.vertices.reserve(3 * triangles);
  loose.triangles.reserve(triangles);
  for (std::uint64_t i = 0; i < triangles; ++i) {
    const double x = random.unit(), y = random.unit(), z = random.unit();
    const double uniform = random.unit();
    const double size = 0.001 + 0.149 * uniform * uniform * uniform;  // mostly small, some large
    const auto corner = [&] {
      const Vec3 inside = Vec3(x, y, z) + size * random.direction();
      return Vec3(inside.cwiseMax(Vec3::Zero()).cwiseMin(Vec3::Ones()));
    };
    const Vec3 a = corner(), b = corner(), c = corner();
    loose.add(a, b, c);
  }
  return std::move(loose).mesh();
}

TriangleMesh degenerate() {
  support::Random random(1234567);
  Loose mixed;
  const TriangleMesh sphere = icosphere(1);
  for (std::size_t i = 0; i < sphere.size(); ++i) {
    mixed.add(0.5 * sphere.corner(i, 0), 0.5 * sphere.corner(i, 1), 0.5 * sphere.corner(i, 2));
    const Vec3 a = dyadic_point(random), b = dyadic_point(random);
    switch (i % 8) {
      case 0:  // a point
        mixed.add(a, a, a);
        break;
      case 1:  // segments with a corner twice
        mixed.add(a, a, b);
        break;
      case 2:
        mixed.add(a, b, a);
        break;
      case 3:
        mixed.add(b, a, a);
        break;
      case 4:  // collinear, the middle corner in each place
        mixed.add(a, 0.5 * (a + b), b);
        break;
      case 5:
        mixed.add(0.25 * (3 * a + b), a, b);
        break;
      case 6:
        mixed.add(a, b, 0.125 * (a + 7 * b));
        break;
      default:  // along an axis, on a corner of the good triangle
        mixed.add(0.5 * sphere.corner(i, 0), 0.5 * sphere.corner(i, 0), 0.5 * sphere.corner(i, 1));
        break;
    }
  }
  return std::move(mixed).mesh();
}

TriangleMesh doubled() {
  const TriangleMesh sphere = icosphere(2);
  std::vector<TriangleMesh::Corners> triangles;
  for (const auto& [a, b, c] : sphere.triangles()) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, b});
  }
  return {std::vector<Vec3>(sphere.vertices().begin(), sphere.vertices().end()), std::move(triangles)};
}

TriangleMesh needles() { return flat_triangles(0); }

TriangleMesh caps() { return flat_triangles(0.5); }

}  // namespace touchmark::bench::meshes
