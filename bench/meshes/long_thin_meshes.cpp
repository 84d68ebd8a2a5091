/// Sized meshes that are long and thin: bundles, tubes, and parts of machines whose flat ends are fans.
#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/meshes/portable_sincos.h"
#include "bench/meshes/sized_meshes.h"
#include "bench/meshes/surface_builder.h"
#include "bench/support/random.h"

namespace touchmark::bench::meshes {
namespace {

std::uint32_t at_least(std::uint64_t value, std::uint32_t least) {
  return std::max(static_cast<std::uint32_t>(value), least);
}

/// A tube of so many triangles along place(t), t from 0 to 1.
template <class Place>
void add_tube_along(Surface& surface, std::uint64_t triangles, double radius, std::uint32_t sides,
                    Place place) {
  const std::uint32_t points = at_least(triangles / (2 * sides), 2);
  std::vector<Vec3> line;
  for (std::uint32_t i = 0; i < points; ++i) line.push_back(place(static_cast<double>(i) / (points - 1)));
  add_tube(surface, line, radius, sides);
}

/// A cylinder along z whose ends are fans: 4 * sides triangles.
void add_cylinder(Surface& surface, const Vec3& foot, double radius, double height, std::uint32_t sides) {
  add_tube(surface, {foot, foot + Vec3(0, 0, height)}, radius, sides);
}

}  // namespace

TriangleMesh hair(std::uint64_t triangles) {
  constexpr std::uint64_t points = 20, sides = 3;
  support::Random random(11);
  Surface surface;
  const std::uint64_t strands = std::max<std::uint64_t>(triangles / tube_triangles(points, sides), 1);
  for (std::uint64_t i = 0; i < strands; ++i) {
    const double u = random.unit(), v = random.unit();
    Vec3 at(0.3 * u, 0.3 * v, 0), way(u - 0.5, v - 0.5, 1);
    const Vec3 curl = random.direction();
    std::vector<Vec3> line;
    for (std::uint64_t k = 0; k < points; ++k) {
      line.push_back(at);
      way += 0.06 * curl + Vec3(0, 0, -0.05);
      at += 0.05 * way / std::sqrt(way.squaredNorm());
    }
    add_tube(surface, line, 0.0004, sides);
  }
  return std::move(surface).mesh();
}

TriangleMesh wires(std::uint64_t triangles) {
  constexpr std::uint64_t points = 2, sides = 3;
  support::Random random(12);
  Surface surface;
  const std::uint64_t count = std::max<std::uint64_t>(triangles / tube_triangles(points, sides), 1);
  for (std::uint64_t i = 0; i < count; ++i) {
    const double y = random.unit(), z = random.unit();
    const double dy = 0.1 * random.unit(), dz = 0.1 * random.unit();
    add_tube(surface, {{0, y, z}, {1, y + dy, z + dz}}, 0.0005, sides);
  }
  return std::move(surface).mesh();
}

TriangleMesh cable(std::uint64_t triangles) {
  constexpr std::uint32_t strands = 37, sides = 6;
  Surface surface;
  for (std::uint32_t i = 0; i < strands; ++i) {
    // Rings of 1, 6, 12 and 18 strands, each ring twisted the other way than the one inside it.
    std::uint32_t ring = 0, first = 0;
    while (i >= first + std::max<std::uint32_t>(6 * ring, 1)) first += std::max<std::uint32_t>(6 * ring++, 1);
    const double start = ring == 0 ? 0 : static_cast<double>(i - first) / (6 * ring);
    add_tube_along(surface, triangles / strands, 0.0049, sides, [&](double t) {
      const SinCos turn = portable_sincos(start + (ring % 2 == 0 ? 3 : -3) * t);
      return Vec3(t, 0.01 * ring * turn.cos, 0.01 * ring * turn.sin);
    });
  }
  return std::move(surface).mesh();
}

TriangleMesh cylinder(std::uint64_t triangles) {
  Surface surface;
  add_cylinder(surface, {0, 0, -0.5}, 0.4, 1, at_least(triangles / 4, 3));
  return std::move(surface).mesh();
}

TriangleMesh bolts(std::uint64_t triangles) {
  constexpr std::uint32_t sides = 48;
  Surface surface;
  add_box(surface, {0, 0, -0.02}, {1, 1, 0});
  std::uint32_t row = 1;
  const std::uint64_t each = std::uint64_t{4} * (sides + 6);  // a shank and a head of six sides
  while (std::uint64_t{row + 1} * (row + 1) * each + 12 <= triangles) ++row;
  for (std::uint32_t i = 0; i < row; ++i) {
    for (std::uint32_t j = 0; j < row; ++j) {
      const Vec3 foot((i + 0.5) / row, (j + 0.5) / row, 0);
      add_cylinder(surface, foot, 0.2 / row, 0.5 / row, sides);
      add_cylinder(surface, foot + Vec3(0, 0, 0.5 / row), 0.35 / row, 0.2 / row, 6);
    }
  }
  return std::move(surface).mesh();
}

TriangleMesh gear(std::uint64_t triangles) {
  // A tooth is four corners, and a corner four triangles: two of the rim, one of each face.
  const std::uint32_t corners = at_least(triangles / 16, 3) * 4;
  Surface surface;
  std::uint32_t rim[2], hub[2];
  for (int face = 0; face < 2; ++face) {
    const double z = face == 0 ? -0.1 : 0.1;
    hub[face] = surface.add({0, 0, z});
    rim[face] = hub[face] + 1;
    for (std::uint32_t i = 0; i < corners; ++i) {
      const SinCos turn = portable_sincos(static_cast<double>(i) / corners);
      const double radius = i % 4 < 2 ? 0.5 : 0.47;
      surface.add({radius * turn.cos, radius * turn.sin, z});
    }
  }
  for (std::uint32_t i = 0; i < corners; ++i) {
    const std::uint32_t next = (i + 1) % corners;
    surface.quad(rim[0] + i, rim[0] + next, rim[1] + next, rim[1] + i);
    surface.triangles.push_back({hub[0], rim[0] + next, rim[0] + i});
    surface.triangles.push_back({hub[1], rim[1] + i, rim[1] + next});
  }
  return std::move(surface).mesh();
}

TriangleMesh spring(std::uint64_t triangles) {
  Surface surface;
  add_tube_along(surface, triangles, 0.012, 12, [](double t) {
    const SinCos turn = portable_sincos(30 * t);
    return Vec3(0.2 * turn.cos, 0.2 * turn.sin, t - 0.5);
  });
  return std::move(surface).mesh();
}

TriangleMesh knot(std::uint64_t triangles) {
  Surface surface;
  add_tube_along(surface, triangles, 0.05, 16, [](double t) {
    const SinCos once = portable_sincos(2 * t), twice = portable_sincos(3 * t);
    const double out = 0.35 + 0.15 * twice.cos;
    return Vec3(out * once.cos, out * once.sin, 0.15 * twice.sin);
  });
  return std::move(surface).mesh();
}

TriangleMesh spikes(std::uint64_t triangles) {
  constexpr std::uint32_t sides = 8;
  support::Random random(13);
  Surface surface;
  for (std::uint64_t i = 0; i < std::max<std::uint64_t>(triangles / (2 * sides), 1); ++i) {
    const Vec3 out = random.direction(), aside = random.direction();
    const Vec3 across = out.cross(aside), side = across / std::sqrt(across.squaredNorm());
    const Vec3 other = out.cross(side);
    const std::uint32_t tip = surface.add((0.3 + 0.2 * random.unit()) * out), foot = surface.add(0.2 * out);
    for (std::uint32_t k = 0; k < sides; ++k) {
      const SinCos turn = portable_sincos(static_cast<double>(k) / sides);
      surface.add(0.21 * out + 0.003 * (turn.cos * side + turn.sin * other));
    }
    for (std::uint32_t k = 0; k < sides; ++k) {
      const std::uint32_t a = foot + 1 + k, b = foot + 1 + (k + 1) % sides;
      surface.triangles.push_back({tip, a, b});
      surface.triangles.push_back({foot, b, a});
    }
  }
  return std::move(surface).mesh();
}

}  // namespace touchmark::bench::meshes
