#include "bench/meshes/surface_builder.h"

#include <cmath>

#include <Eigen/Geometry>

#include "bench/meshes/portable_sincos.h"

namespace touchmark::bench::meshes {
namespace {

/// Returns a unit vector across the direction, as little turned against `before` as can be.
Vec3 across(const Vec3& direction, const Vec3& before) {
  Vec3 side = before - before.dot(direction) * direction;
  if (!(side.squaredNorm() > 1e-6)) {
    int least = 0;
    direction.cwiseAbs().minCoeff(&least);
    side = Vec3::Unit(least) - direction[least] * direction;
  }
  return side / std::sqrt(side.squaredNorm());
}

}  // namespace

void add_box(Surface& surface, const Vec3& low, const Vec3& high) {
  const auto first = static_cast<std::uint32_t>(surface.vertices.size());
  for (std::uint32_t i = 0; i < 8; ++i)
    surface.add({(i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                 (i & 4) != 0 ? high.z() : low.z()});
  constexpr std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : faces)
    surface.quad(first + face[0], first + face[1], first + face[2], first + face[3]);
}

void add_tube(Surface& surface, const std::vector<Vec3>& line, double radius, std::uint32_t sides) {
  const auto points = static_cast<std::uint32_t>(line.size());
  const auto first = static_cast<std::uint32_t>(surface.vertices.size());
  Vec3 side = Vec3::Zero();
  for (std::uint32_t i = 0; i < points; ++i) {
    const Vec3 way = line[i + 1 < points ? i + 1 : i] - line[i > 0 ? i - 1 : 0];
    const Vec3 direction = way / std::sqrt(way.squaredNorm());
    side = across(direction, side);
    const Vec3 other = direction.cross(side);
    for (std::uint32_t k = 0; k < sides; ++k) {
      const SinCos turn = portable_sincos(static_cast<double>(k) / sides);
      surface.add(line[i] + radius * (turn.cos * side + turn.sin * other));
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t k) { return first + i * sides + k % sides; };
  for (std::uint32_t i = 0; i + 1 < points; ++i)
    for (std::uint32_t k = 0; k < sides; ++k)
      surface.quad(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
  const std::uint32_t begin = surface.add(line.front()), end = surface.add(line.back());
  for (std::uint32_t k = 0; k < sides; ++k) {
    surface.triangles.push_back({begin, at(0, k + 1), at(0, k)});
    surface.triangles.push_back({end, at(points - 1, k), at(points - 1, k + 1)});
  }
}

}  // namespace touchmark::bench::meshes
