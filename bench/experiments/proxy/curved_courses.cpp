// Courses over meshes of other kinds: curved, badly shaped, open, crossing themselves, of any size.
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/proxy/course_makers.h"
#include "bench/meshes/generated_meshes.h"

namespace touchmark::bench::experiments::proxy {
namespace {

/// The diagonal of the mesh becomes the usual size, turned any way.
TriangleMesh sized(const TriangleMesh& mesh, support::Random& random) {
  return placed(mesh, course_size / mesh.diagonal(), any_frame(random));
}

template <std::size_t count, class Make>
std::vector<Course> explored(std::string_view what, std::uint64_t seed, std::uint64_t salt, std::size_t ticks,
                             Make make) {
  std::vector<Course> made;
  for (std::size_t i = 0; i < count; ++i) {
    support::Random random(seed * course_seed + salt + i);
    made.push_back(exploring(fmt::format("{} {}", what, i), make(i, random), radius_of(i, course_size),
                             seed * course_seed + salt + 500 + i, share_of(ticks, count)));
  }
  return made;
}

/// Keeps each triangle with this probability.
TriangleMesh thinned(const TriangleMesh& mesh, support::Random& random, double kept) {
  std::vector<meshes::Corners> triangles;
  for (const meshes::Corners& corners : mesh.triangles())
    if (triangles.empty() || random.unit() < kept) triangles.push_back(corners);
  return {{mesh.vertices().begin(), mesh.vertices().end()}, std::move(triangles)};
}

}  // namespace

std::vector<Course> saddles(std::uint64_t seed, std::size_t ticks) {
  return explored<4>("saddle", seed, 140, ticks, [](std::size_t i, support::Random& random) {
    const double bend = random.between(1, 8);
    meshes::Surface surface;
    const auto squares = static_cast<std::uint32_t>(4 << i);
    meshes::add_patch(surface, squares, squares, [&](double u, double v) {
      const double x = (u - 0.5) * course_size, y = (v - 0.5) * course_size;
      return Vec3(x, y, bend * (x * x - y * y));
    });
    return placed(std::move(surface).mesh(), 1, any_frame(random));
  });
}

std::vector<Course> convex_edges(std::uint64_t seed, std::size_t ticks) {
  return explored<4>("solid", seed, 160, ticks, [](std::size_t i, support::Random& random) {
    return i < 2 ? sized(meshes::cube(), random)
                 : sized(meshes::icosphere(static_cast<unsigned>(i - 2)), random);
  });
}

std::vector<Course> needle_fans(std::uint64_t seed, std::size_t ticks) {
  return explored<4>("needles", seed, 180, ticks, [](std::size_t i, support::Random& random) {
    return sized(i < 2 ? meshes::sliver_fan() : i == 2 ? meshes::needles() : meshes::caps(), random);
  });
}

/// Coarse squares beside fine ones, turned, so that what would be vertices on an edge are so to rounding
/// only.
std::vector<Course> t_junctions(std::uint64_t seed, std::size_t ticks) {
  return explored<4>("junctions", seed, 200, ticks, [](std::size_t i, support::Random& random) {
    meshes::Surface surface;
    const auto fine = static_cast<std::uint32_t>(3 + 2 * i);
    const double half = course_size / 2;
    meshes::add_patch(surface, 2, 2,
                      [&](double u, double v) { return Vec3(half * (u - 1), half * (v - 0.5), 0); });
    meshes::add_patch(surface, fine, fine,
                      [&](double u, double v) { return Vec3(half * u, half * (v - 0.5), 0); });
    return placed(std::move(surface).mesh(), 1, any_frame(random));
  });
}

std::vector<Course> holes(std::uint64_t seed, std::size_t ticks) {
  return explored<4>("open surface", seed, 220, ticks, [](std::size_t i, support::Random& random) {
    return sized(thinned(i < 2 ? meshes::noisy_sphere(800) : meshes::icosphere(3), random, 0.9), random);
  });
}

std::vector<Course> self_intersections(std::uint64_t seed, std::size_t ticks) {
  return explored<4>("crossing parts", seed, 240, ticks, [](std::size_t i, support::Random& random) {
    if (i == 3) return sized(meshes::soup(60), random);
    meshes::Surface surface;
    for (int part = 0; part < 3; ++part)
      surface.part(placed(i == 0 ? meshes::cube() : meshes::icosphere(1), 0.5, any_frame(random)), 1,
                   0.2 * random.direction());
    return sized(std::move(surface).mesh(), random);
  });
}

std::vector<Course> doubled_faces(std::uint64_t seed, std::size_t ticks) {
  return explored<4>("doubled", seed, 260, ticks, [](std::size_t i, support::Random& random) {
    return sized(i < 2 ? meshes::doubled() : meshes::degenerate(), random);
  });
}

/// One bumpy ball from a centimetre to ten metres across.
std::vector<Course> scaled_meshes(std::uint64_t seed, std::size_t ticks) {
  constexpr std::array sizes{0.01, 0.1, 1.0, 10.0, 0.01, 0.1, 1.0, 10.0};
  std::vector<Course> made;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    support::Random random(seed * course_seed + 280 + i);
    const TriangleMesh ball = meshes::noisy_sphere(2000);
    made.push_back(exploring(fmt::format("{:g} m", sizes[i]),
                             placed(ball, sizes[i] / ball.diagonal(), any_frame(random)),
                             i < sizes.size() / 2 ? 0.02 * sizes[i] : 0, seed * course_seed + 300 + i,
                             share_of(ticks, sizes.size())));
  }
  return made;
}

}  // namespace touchmark::bench::experiments::proxy
