// Courses over planes: plates, wedges, corners, rooms and cracks. Where the free space is convex, the planes
// that bound it say what the optimum is.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/proxy/course_makers.h"
#include "bench/meshes/portable_sincos.h"
#include "core/float_limits.h"

namespace touchmark::bench::experiments::proxy {
namespace {

/// Presses goals of a ball of `reach` about `middle`, one after the other, with rests between.
std::vector<Vec3> pressing(support::Random& random, const Vec3& start, const Vec3& middle, double reach,
                           std::size_t ticks) {
  Motion motion(start, ticks);
  while (!motion.done()) {
    motion.line(middle + random.between(0, reach) * random.direction(), 10 + random.below(40));
    if (random.below(3) == 0) motion.rest(16);
    if (random.below(4) == 0) motion.jump(middle + reach * random.direction());
    if (random.below(4) == 0) motion.tremor(random, 0.1 * reach, 20);
  }
  return std::move(motion).take();
}

/// The n-th double below x.
double below(double x, std::uint64_t n) {
  for (; n > 0; --n) x = std::nextafter(x, -infinity);
  return x;
}

double min_height(const TriangleMesh& mesh, const Vec3& at) {
  double least = infinity;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const Vec3 normal = (mesh.corner(i, 1) - mesh.corner(i, 0)).cross(mesh.corner(i, 2) - mesh.corner(i, 0));
    least = std::min(least, std::abs(normal.normalized().dot(at - mesh.corner(i, 0))));
  }
  return least;
}

std::vector<std::uint32_t> all_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> all(mesh.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

}  // namespace

/// Thickness from a centimetre down to one ulp. The goal stabs and presses well inside the plate's borders,
/// so the plane on top is all that matters to it.
std::vector<Course> thin_plates(std::uint64_t seed, std::size_t ticks) {
  constexpr std::array thicknesses{1e-2, 1e-3, 1e-5, 1e-8, 1e-12, 0.0, 0.0, 0.0};
  std::vector<Course> made;
  for (std::size_t i = 0; i < thicknesses.size(); ++i) {
    support::Random random(seed * course_seed + i);
    const double top = 0.0625 + 0.001 * random.unit();
    const double bottom = thicknesses[i] > 0 ? top - thicknesses[i] : below(top, i - 4);
    meshes::Surface surface;
    meshes::add_box(surface, Vec3(-2, -2, bottom), Vec3(2, 2, top));
    TriangleMesh mesh = std::move(surface).mesh();
    std::vector<std::uint32_t> bounds;
    for (std::uint32_t t = 0; t < mesh.size() && bounds.empty(); ++t)
      if (mesh.corner(t, 0).z() == top && mesh.corner(t, 1).z() == top && mesh.corner(t, 2).z() == top)
        bounds.push_back(t);
    const Vec3 start(0, 0, top + 0.05);
    std::vector<Vec3> goals =
        pressing(random, start, Vec3(0, 0, top - 0.02), course_size, share_of(ticks, thicknesses.size()));
    made.push_back({fmt::format("plate {:.3g} thick", top - bottom), std::move(mesh),
                    radius_of(i, course_size), 0, start, std::move(goals), std::move(bounds)});
  }
  return made;
}

/// A groove between two faces, the ball in it.
std::vector<Course> wedges_inside(std::uint64_t seed, std::size_t ticks) {
  constexpr std::array degrees{1.0, 5.0, 30.0, 60.0, 90.0, 120.0, 170.0, 179.0};
  std::vector<Course> made;
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    support::Random random(seed * course_seed + 20 + i);
    const Frame frame = random.below(2) == 0 ? upright() : any_frame(random);
    const meshes::SinCos half = meshes::portable_sincos(degrees[i] / 720);
    const Vec3 along(0, 4, 0), up(4 * half.cos, 0, 4 * half.sin), down(4 * half.cos, 0, -4 * half.sin);
    // Each face is one triangle, large enough that its sides are never met.
    std::vector<Vec3> vertices{frame(-along), frame(along), frame(up), frame(down)};
    TriangleMesh mesh(std::move(vertices), {{0, 1, 2}, {1, 0, 3}});
    const Vec3 start = frame(Vec3(0.05, 0, 0));
    const double radius = i % 2 == seed % 2 ? std::min(0.005, 0.3 * min_height(mesh, start)) : 0;
    std::vector<Vec3> goals =
        pressing(random, start, Vec3::Zero(), course_size, share_of(ticks, degrees.size()));
    std::vector<std::uint32_t> bounds = all_of(mesh);
    made.push_back({fmt::format("groove of {:g} degrees", degrees[i]), std::move(mesh), radius, 0, start,
                    std::move(goals), std::move(bounds)});
  }
  return made;
}

/// A blade that the ball slides over.
std::vector<Course> wedges_outside(std::uint64_t seed, std::size_t ticks) {
  constexpr std::array degrees{1.0, 5.0, 30.0, 90.0, 150.0, 179.0};
  std::vector<Course> made;
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    support::Random random(seed * course_seed + 40 + i);
    const meshes::SinCos half = meshes::portable_sincos(degrees[i] / 720);
    const double deep = 0.05;
    meshes::Surface surface;  // a prism: the edge at x = 0, its back at x = -deep
    for (const double y : {-0.05, 0.05}) {
      surface.add(Vec3(0, y, 0));
      surface.add(Vec3(-deep, y, deep * half.sin / half.cos));
      surface.add(Vec3(-deep, y, -deep * half.sin / half.cos));
    }
    surface.quad(0, 3, 4, 1), surface.quad(1, 4, 5, 2), surface.quad(2, 5, 3, 0);
    surface.triangles.push_back({0, 1, 2});
    surface.triangles.push_back({3, 5, 4});
    TriangleMesh mesh = placed(std::move(surface).mesh(), 1, any_frame(random));
    made.push_back(exploring(fmt::format("blade of {:g} degrees", degrees[i]), std::move(mesh),
                             radius_of(i + seed, course_size), seed * course_seed + 60 + i,
                             share_of(ticks, degrees.size())));
  }
  return made;
}

/// Three planes meet: any directions, none too flat.
std::vector<Course> corners(std::uint64_t seed, std::size_t ticks) {
  constexpr std::size_t count = 6;
  std::vector<Course> made;
  for (std::size_t i = 0; i < count; ++i) {
    support::Random random(seed * course_seed + 80 + i);
    std::array<Vec3, 3> edges;
    double volume = 0;
    do {
      for (Vec3& edge : edges) edge = random.direction();
      volume = edges[0].cross(edges[1]).dot(edges[2]);
    } while (volume < 0.05 ||
             std::min({edges[0].dot(edges[1]), edges[1].dot(edges[2]), edges[2].dot(edges[0])}) < -0.7);
    const double size = 4;
    TriangleMesh mesh({Vec3::Zero(), size * edges[0], size * edges[1], size * edges[2]},
                      {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}});
    const Vec3 start = 0.05 * (edges[0] + edges[1] + edges[2]).normalized();
    const double radius = i % 2 == 0 ? std::min(0.005, 0.3 * min_height(mesh, start)) : 0;
    std::vector<Vec3> goals = pressing(random, start, Vec3::Zero(), 0.05, share_of(ticks, count));
    std::vector<std::uint32_t> bounds = all_of(mesh);
    made.push_back({fmt::format("corner {}", i), std::move(mesh), radius, 0, start, std::move(goals),
                    std::move(bounds)});
  }
  return made;
}

/// A box seen from inside; the goal goes out through faces, edges and corners.
std::vector<Course> rooms(std::uint64_t seed, std::size_t ticks) {
  constexpr std::size_t count = 4;
  std::vector<Course> made;
  for (std::size_t i = 0; i < count; ++i) {
    support::Random random(seed * course_seed + 100 + i);
    meshes::Surface surface;
    meshes::add_box(surface, Vec3(-0.05, -0.04, -0.03), Vec3(0.05, 0.04, 0.03));
    for (meshes::Corners& corners : surface.triangles)
      std::swap(corners[1], corners[2]);  // faces look inwards
    TriangleMesh mesh = placed(std::move(surface).mesh(), 1, i < 2 ? upright() : any_frame(random));
    std::vector<Vec3> goals =
        pressing(random, Vec3::Zero(), Vec3::Zero(), course_size, share_of(ticks, count));
    std::vector<std::uint32_t> bounds = all_of(mesh);
    made.push_back({fmt::format("room {}", i), std::move(mesh), radius_of(i, course_size), 0, Vec3::Zero(),
                    std::move(goals), std::move(bounds)});
  }
  return made;
}

/// Two plates side by side, a crack between them: of one ulp, or of an edge's length that the ball fits into
/// or not. The goal slides along the crack and below it.
std::vector<Course> cracks(std::uint64_t seed, std::size_t ticks) {
  constexpr std::array widths{0.0, 0.0, 1e-12, 1e-6, 0.004, 0.01};
  std::vector<Course> made;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    support::Random random(seed * course_seed + 120 + i);
    const double left = 0.01 + 0.001 * random.unit();
    const double right = widths[i] > 0 ? left + widths[i] : std::nextafter(left, infinity);
    constexpr std::uint32_t squares = 8;
    meshes::Surface surface;
    meshes::add_patch(surface, squares, squares, [&](double u, double v) {
      return Vec3(left + (u - 1) * course_size, (v - 0.5) * course_size, 0);
    });
    meshes::add_patch(surface, squares, squares, [&](double u, double v) {
      return Vec3(right + u * course_size, (v - 0.5) * course_size, 0);
    });
    const Vec3 start(left, 0, 0.03);
    Motion motion(start, share_of(ticks, widths.size()));
    while (!motion.done()) {
      const double y = random.between(-0.04, 0.04), depth = random.between(0, 0.02);
      motion.line(Vec3(random.between(left - 0.02, right + 0.02), y, 0.01), 20);
      motion.line(Vec3(left, y, -depth), 15);                            // to the crack's very line
      motion.line(Vec3(left, random.between(-0.04, 0.04), -depth), 30);  // along it
      motion.line(Vec3(right, motion.at().y(), -depth), 5);              // to its other side
      motion.line(Vec3(random.between(left - 0.02, right + 0.02), y, -depth), 20);
      motion.rest(14);
      motion.line(Vec3(left, y, 0.01), 20);
    }
    made.push_back({fmt::format("crack {:.3g} wide", right - left), std::move(surface).mesh(),
                    radius_of(i, course_size), 0, start, std::move(motion).take()});
  }
  return made;
}

}  // namespace touchmark::bench::experiments::proxy
