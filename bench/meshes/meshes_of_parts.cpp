/// Sized meshes of many parts: what lies scattered, stacked or beside something far larger.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bench/meshes/generated_meshes.h"
#include "bench/meshes/portable_noise.h"
#include "bench/meshes/sized_meshes.h"
#include "bench/meshes/surface_builder.h"
#include "bench/support/random.h"

namespace touchmark::bench::meshes {
namespace {

constexpr std::uint64_t box_triangles = 12;

Vec3 random_point(support::Random& random) {
  const double x = random.unit(), y = random.unit(), z = random.unit();
  return {x, y, z};
}

void add_triangle(Surface& surface, const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::uint32_t first = surface.add(a);
  surface.add(b);
  surface.add(c);
  surface.triangles.push_back({first, first + 1, first + 2});
}

/// Returns the largest whole number whose square, or cube, is at most `value`.
std::uint32_t whole_root(std::uint64_t value, int power) {
  std::uint64_t root = 1;
  const auto raised = [&](std::uint64_t x) { return power == 2 ? x * x : x * x * x; };
  while (raised(root + 1) <= value) ++root;
  return static_cast<std::uint32_t>(root);
}

/// Returns a ball of the finest icosphere that leaves room for `balls` of them, 20 triangles at least.
TriangleMesh ball_for(std::uint64_t triangles, std::uint64_t balls) {
  unsigned levels = 0;
  while (levels < 6 && (std::uint64_t{20} << (2 * levels + 2)) * balls <= triangles) ++levels;
  return icosphere(levels);
}

}  // namespace

TriangleMesh large_soup(std::uint64_t triangles) {
  support::Random random(1);
  Surface surface;
  for (std::uint64_t i = 0; i < triangles; ++i) {
    const Vec3 a = random_point(random), b = random_point(random), c = random_point(random);
    add_triangle(surface, a, b, c);
  }
  return std::move(surface).mesh();
}

TriangleMesh dust(std::uint64_t triangles) {
  support::Random random(2);
  Surface surface;
  const double size = 0.1 / whole_root(triangles, 3);
  for (std::uint64_t i = 0; i < triangles; ++i) {
    const Vec3 center = random_point(random);
    const Vec3 a = random.direction(), b = random.direction(), c = random.direction();
    add_triangle(surface, center + size * a, center + size * b, center + size * c);
  }
  return std::move(surface).mesh();
}

TriangleMesh clusters(std::uint64_t triangles) {
  support::Random random(3);
  Surface surface;
  const TriangleMesh ball = ball_for(triangles, 200);
  const std::uint64_t balls = std::max<std::uint64_t>(triangles / ball.size(), 1);
  std::vector<Vec3> centers;
  for (int i = 0; i < 12; ++i) centers.push_back(random_point(random));
  for (std::uint64_t i = 0; i < balls; ++i) {
    const Vec3 away = random.direction();
    const double distance = 0.03 * random.unit();
    surface.part(ball, 0.004, centers[i % centers.size()] + distance * away);
  }
  return std::move(surface).mesh();
}

TriangleMesh pebbles(std::uint64_t triangles) {
  support::Random random(4);
  Surface surface;
  const TriangleMesh ball = ball_for(triangles, 300);
  for (std::uint64_t i = 0; i < std::max<std::uint64_t>(triangles / ball.size(), 1); ++i) {
    double radius = 0.15;  // from there down to a thousandth, as many of each octave
    for (double octaves = 8 * random.unit(); octaves > 0; --octaves) radius /= 1 + std::min(octaves, 1.0);
    surface.part(ball, radius, random_point(random));
  }
  return std::move(surface).mesh();
}

TriangleMesh giant_quad(std::uint64_t triangles) {
  Surface surface;
  add_patch(surface, 1, 1, [](double u, double v) { return Vec3(u - 0.5, v - 0.5, 0); });
  surface.part(noisy_sphere(triangles - 2), 0.02, {0.2, 0.1, 0.03});
  return std::move(surface).mesh();
}

TriangleMesh boxes(std::uint64_t triangles) {
  support::Random random(5);
  Surface surface;
  const std::uint32_t row = whole_root((triangles - 2) / box_triangles, 2);
  add_patch(surface, 1, 1, [](double u, double v) { return Vec3(u, v, 0); });
  for (std::uint32_t i = 0; i < row; ++i) {
    for (std::uint32_t j = 0; j < row; ++j) {
      const double x = (i + 0.4 * random.unit()) / row, y = (j + 0.4 * random.unit()) / row;
      const double wide = (0.2 + 0.4 * random.unit()) / row, high = (0.2 + 2 * random.unit()) / row;
      add_box(surface, {x, y, 0}, {x + wide, y + wide, high});
    }
  }
  return std::move(surface).mesh();
}

TriangleMesh crates(std::uint64_t triangles) {
  Surface surface;
  const std::uint32_t row = whole_root(triangles / box_triangles, 3);
  const double edge = 1.0 / row;
  for (std::uint32_t i = 0; i < row; ++i)
    for (std::uint32_t j = 0; j < row; ++j)
      for (std::uint32_t k = 0; k < row; ++k)
        add_box(surface, {i * edge, j * edge, k * edge}, {(i + 1) * edge, (j + 1) * edge, (k + 1) * edge});
  return std::move(surface).mesh();
}

/// A solid of cubes where noise is high, as a scanner's volume is turned into a surface.
TriangleMesh voxels(std::uint64_t triangles) {
  for (std::uint32_t row = 2 + whole_root(triangles, 2);; row -= 1 + row / 12) {
    const auto solid = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
      return x < row && y < row && z < row && bumps(5.0 / row * Vec3(x, y, z), 6) > 0.05;
    };
    Surface surface;
    const auto face = [&](const Vec3& from, const Vec3& u, const Vec3& v) {
      const std::uint32_t a = surface.add(from / row);
      surface.add((from + u) / row);
      surface.add((from + u + v) / row);
      surface.add((from + v) / row);
      surface.quad(a, a + 1, a + 2, a + 3);
    };
    for (std::uint32_t x = 0; x < row; ++x) {
      for (std::uint32_t y = 0; y < row; ++y) {
        for (std::uint32_t z = 0; z < row; ++z) {
          if (!solid(x, y, z)) continue;
          const Vec3 low(x, y, z), high = low + Vec3::Ones();
          const Vec3 i = Vec3::UnitX(), j = Vec3::UnitY(), k = Vec3::UnitZ();
          // Below zero the index wraps round to a number that is no voxel's.
          if (!solid(x - 1, y, z)) face(low, k, j);
          if (!solid(x, y - 1, z)) face(low, i, k);
          if (!solid(x, y, z - 1)) face(low, j, i);
          if (!solid(x + 1, y, z)) face(high, -k, -j);
          if (!solid(x, y + 1, z)) face(high, -i, -k);
          if (!solid(x, y, z + 1)) face(high, -j, -i);
        }
      }
    }
    if (surface.triangles.size() <= triangles && !surface.triangles.empty()) return std::move(surface).mesh();
    if (row <= 2) return cube();
  }
}

TriangleMesh truss(std::uint64_t triangles) {
  Surface surface;
  std::uint32_t row = 1;
  const auto beams = [](std::uint64_t n) { return 3 * n * (n + 1) * (n + 1); };
  while (beams(row + 1) * box_triangles <= triangles) ++row;
  const double thick = 0.03 / row;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::uint32_t i = 0; i <= row; ++i) {
      for (std::uint32_t j = 0; j <= row; ++j) {
        for (std::uint32_t k = 0; k < row; ++k) {
          Vec3 low;
          low[axis] = static_cast<double>(k) / row;
          low[(axis + 1) % 3] = static_cast<double>(i) / row;
          low[(axis + 2) % 3] = static_cast<double>(j) / row;
          Vec3 high = low + Vec3::Constant(thick);
          high[axis] = low[axis] + 1.0 / row;
          add_box(surface, low, high);
        }
      }
    }
  }
  return std::move(surface).mesh();
}

TriangleMesh fins(std::uint64_t triangles) {
  Surface surface;
  const auto count = static_cast<std::uint32_t>(triangles / box_triangles - 1);
  const double pitch = 1.0 / count;
  for (std::uint32_t i = 0; i < count; ++i)
    add_box(surface, {i * pitch, 0, 0.1}, {(i + 0.2) * pitch, 1, 0.5});
  add_box(surface, {0, 0, 0}, {1, 1, 0.1});
  return std::move(surface).mesh();
}

}  // namespace touchmark::bench::meshes
