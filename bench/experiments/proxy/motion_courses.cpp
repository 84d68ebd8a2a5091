// Courses that are hard by their motion: stabs, rests, circles, tremor, friction, and a mesh that moves.
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/proxy/course_makers.h"
#include "bench/meshes/deformation.h"
#include "bench/meshes/generated_meshes.h"

namespace touchmark::bench::experiments::proxy {
namespace {

constexpr std::size_t courses = 4;

TriangleMesh solid(std::size_t i, support::Random& random) {
  const TriangleMesh mesh = i % 4 < 2    ? meshes::noisy_sphere(1000)
                            : i % 4 == 2 ? meshes::torus(24, 12)
                                         : meshes::cube();
  return placed(mesh, course_size / mesh.diagonal(), any_frame(random));
}

/// Writes a course's motion: write(motion, random, size, start).
template <class Write>
std::vector<Course> moved_over_solids(std::string_view what, std::uint64_t seed, std::uint64_t salt,
                                      std::size_t ticks, Write write) {
  std::vector<Course> made;
  for (std::size_t i = 0; i < courses; ++i) {
    support::Random random(seed * course_seed + salt + i);
    TriangleMesh mesh = solid(i, random);
    const double radius = radius_of(i / 2 + i, course_size);
    const Vec3 start = (0.6 * course_size + 2 * radius) * random.direction();
    Motion motion(start, share_of(ticks, courses));
    while (!motion.done()) write(motion, random);
    made.push_back(
        {fmt::format("{} {}", what, i), std::move(mesh), radius, 0, start, std::move(motion).take()});
  }
  return made;
}

Vec3 out_of(support::Random& random) { return 0.6 * course_size * random.direction(); }

}  // namespace

/// 100 diagonals a second: a tenth of one each tick.
std::vector<Course> stabs(std::uint64_t seed, std::size_t ticks) {
  return moved_over_solids("stabs", seed, 320, ticks, [](Motion& motion, support::Random& random) {
    const Vec3 to = -motion.at() + 0.3 * course_size * random.direction();
    motion.line(to, 1 + static_cast<std::size_t>((to - motion.at()).norm() / (0.1 * course_size)));
    if (random.below(2) == 0) motion.jump(out_of(random));
  });
}

std::vector<Course> rest_inside(std::uint64_t seed, std::size_t ticks) {
  return moved_over_solids("rest", seed, 340, ticks, [](Motion& motion, support::Random& random) {
    motion.line(0.3 * course_size * random.unit() * random.direction(), 30);
    motion.rest(60);
    if (random.below(2) == 0) motion.line(out_of(random), 30);
  });
}

std::vector<Course> circles(std::uint64_t seed, std::size_t ticks) {
  constexpr std::size_t turn = 200;
  std::vector<Course> made;
  for (std::size_t i = 0; i < courses; ++i) {
    support::Random random(seed * course_seed + 360 + i);
    TriangleMesh mesh = solid(i, random);
    const double radius = radius_of(i, course_size);
    const Frame frame = any_frame(random);
    const double size = random.between(0.1, 0.6) * course_size;
    const Vec3 start = frame((0.7 * course_size + 2 * radius) * Vec3::UnitX());
    const Vec3 center = start - frame(size * Vec3::UnitX());  // so the circle begins where the proxy starts
    Motion motion(start, share_of(ticks, courses) / turn * turn + turn);
    while (!motion.done())
      motion.circle(center, frame(size * Vec3::UnitX()), frame(size * Vec3::UnitY()), turn);
    made.push_back(
        {fmt::format("circle {}", i), std::move(mesh), radius, 0, start, std::move(motion).take(), {}, turn});
  }
  return made;
}

std::vector<Course> tremors(std::uint64_t seed, std::size_t ticks) {
  return moved_over_solids("tremor", seed, 380, ticks, [](Motion& motion, support::Random& random) {
    motion.line(0.4 * course_size * random.unit() * random.direction(), 40);
    motion.tremor(random, 0.02 * course_size * random.unit(), 150);
    if (random.below(2) == 0) motion.line(out_of(random), 30);
  });
}

std::vector<Course> friction(std::uint64_t seed, std::size_t ticks) {
  std::vector<Course> made;
  for (std::size_t i = 0; i < courses; ++i) {
    support::Random random(seed * course_seed + 400 + i);
    made.push_back(exploring(fmt::format("friction {}", i), solid(i, random), radius_of(i, course_size),
                             seed * course_seed + 420 + i, share_of(ticks, courses)));
    made.back().friction = random.between(0.1, 1);
  }
  return made;
}

/// Every ten ticks the surface goes a fifth of its way to another shape or back.
std::vector<Course> deforming(std::uint64_t seed, std::size_t ticks) {
  constexpr std::size_t phases = 5, every = 10;
  std::vector<Course> made;
  for (std::size_t i = 0; i < courses; ++i) {
    support::Random random(seed * course_seed + 440 + i);
    const TriangleMesh mesh = solid(i, random);
    const TriangleMesh other = meshes::deformed(mesh, {i % 2 == 0 ? 1.0 : 0.3, seed + i});
    made.push_back(exploring(fmt::format("deforming {}", i), mesh, radius_of(i, course_size),
                             seed * course_seed + 460 + i, share_of(ticks, courses)));
    made.back().update_every = every;
    made.back().moved = [mesh, other](std::size_t change) {
      const std::size_t phase = change % (2 * phases);
      const double part = static_cast<double>(phase <= phases ? phase : 2 * phases - phase) / phases;
      std::vector<Vec3> vertices;
      for (std::size_t v = 0; v < mesh.vertices().size(); ++v)
        vertices.emplace_back(mesh.vertices()[v] + part * (other.vertices()[v] - mesh.vertices()[v]));
      return TriangleMesh(std::move(vertices), {mesh.triangles().begin(), mesh.triangles().end()},
                          {mesh.ids().begin(), mesh.ids().end()});
    };
  }
  return made;
}

}  // namespace touchmark::bench::experiments::proxy
