// Courses among bodies that move between the ticks: pushed into the proxy, and closing on it from two sides.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/proxy/course_makers.h"
#include "bench/meshes/generated_meshes.h"

namespace touchmark::bench::experiments::proxy {
namespace {

/// Vertices and places are multiples of this, and so small that their sums are exact: a body that is moved
/// and a mesh that is summed are the same surface.
constexpr double grid = 0x1p-30;

Vec3 on_grid(const Vec3& at) { return (at / grid).array().round() * grid; }

TriangleMesh on_grid(const TriangleMesh& mesh) {
  std::vector<Vec3> vertices;
  for (const Vec3& vertex : mesh.vertices()) vertices.push_back(on_grid(vertex));
  return {std::move(vertices), {mesh.triangles().begin(), mesh.triangles().end()}};
}

/// A body's way to and fro.
struct Sway {
  Vec3 about, by;
  Swing swing;

  Vec3 at(std::size_t change) const { return on_grid(about + swing.at(change) * by); }
};

struct Swinging {
  std::vector<TriangleMesh> bodies;
  std::vector<Sway> sways;

  void add(const TriangleMesh& mesh, const Sway& sway) {
    bodies.push_back(on_grid(mesh));
    sways.push_back(sway);
  }
};

/// Two slabs that close on what is between them, nearer than the ball is wide, and a block that comes in from
/// the side.
Swinging press(double radius, support::Random& random) {
  const double half = course_size / 2, thick = course_size / 10;
  const double least = random.between(0.2, 1.2) * radius + 0.002 * course_size;
  const double swing = random.between(1, 4) * radius + 0.02 * course_size,
               period = 20 + random.between(0, 60);
  meshes::Surface slab, block;
  meshes::add_box(slab, {-half, -half, -thick}, {half, half, 0});
  meshes::add_box(block, {0, -half / 4, -half / 4}, {half, half / 4, half / 4});
  const TriangleMesh below = std::move(slab).mesh();
  Swinging made;
  const Vec3 up = Vec3::UnitZ();
  made.add(below, {-(least + swing) * up, swing * up, {period, 0}});
  made.add(below, {(least + swing + thick) * up, -swing * up, {period, 0}});
  made.add(std::move(block).mesh(),
           {half * Vec3::UnitX(), 0.9 * half * Vec3::UnitX(), {30 + random.between(0, 50), random.unit()}});
  return made;
}

/// Solids that pass one another, and through the middle.
Swinging crowd(support::Random& random) {
  Swinging made;
  for (std::size_t i = 0; i < 5; ++i) {
    const TriangleMesh mesh = i % 2 == 0 ? meshes::noisy_sphere(100) : meshes::cube();
    const TriangleMesh solid =
        placed(mesh, random.between(0.2, 0.5) * course_size / mesh.diagonal(), any_frame(random));
    made.add(solid, {0.3 * course_size * random.unit() * random.direction(),
                     random.between(0.1, 0.5) * course_size * random.direction(),
                     {40 + random.between(0, 160), random.unit()}});
  }
  return made;
}

std::vector<Vec3> places_of(const Swinging& made, std::size_t change) {
  std::vector<Vec3> places;
  for (const Sway& sway : made.sways) places.push_back(sway.at(change));
  return places;
}

TriangleMesh mesh_of(const Swinging& made, std::size_t change) {
  const std::vector<Vec3> places = places_of(made, change);
  meshes::Surface surface;
  for (std::size_t i = 0; i < made.bodies.size(); ++i) surface.part(made.bodies[i], 1, places[i]);
  return std::move(surface).mesh();
}

/// A piston or a solid that goes all the way through the middle between two ticks.
Swinging passing(bool is_piston, support::Random& random) {
  meshes::Surface slab;
  meshes::add_box(slab, Vec3(-1, -1, -0.01) * course_size, Vec3(1, 1, 0.01) * course_size);
  const TriangleMesh piston = std::move(slab).mesh(), solid = meshes::noisy_sphere(100);
  const Vec3 way = is_piston ? Vec3::UnitZ() : random.direction();
  Swinging made;
  made.add(is_piston ? piston : placed(solid, 0.5 * course_size / solid.diagonal(), any_frame(random)),
           {Vec3::Zero(), 0.9 * course_size * way, {random.between(2.2, 6), random.unit()}});
  return made;
}

/// The goal goes about the middle while bodies move after every so many ticks.
Course course_among(std::string name, Swinging bodies, double radius, std::size_t changes_every,
                    std::size_t ticks, support::Random& random) {
  const auto swinging = std::make_shared<const Swinging>(std::move(bodies));
  const Vec3 start(0, 0, 1.5 * course_size);
  Course course{
      std::move(name), mesh_of(*swinging, 0), radius, 0, start, about_the_middle(start, ticks, random)};
  course.update_every = changes_every;
  course.moved = [swinging](std::size_t change) { return mesh_of(*swinging, change); };
  course.bodies = swinging->bodies;
  course.places = [swinging](std::size_t change) { return places_of(*swinging, change); };
  return course;
}

}  // namespace

std::vector<Course> moving_bodies(std::uint64_t seed, std::size_t ticks) {
  constexpr std::size_t count = 4;
  constexpr std::array<std::size_t, count> changes_every{1, 2, 5, 3};
  std::vector<Course> made;
  for (std::size_t i = 0; i < count; ++i) {
    support::Random random(seed * course_seed + 480 + i);
    const double radius = radius_of(i, course_size);
    Swinging bodies = i < 2 ? press(radius, random) : crowd(random);
    made.push_back(course_among(fmt::format("{} {}", i < 2 ? "press" : "crowd", i), std::move(bodies), radius,
                                changes_every.at(i), share_of(ticks, count), random));
  }
  return made;
}

std::vector<Course> passing_bodies(std::uint64_t seed, std::size_t ticks) {
  constexpr std::size_t count = 4;
  std::vector<Course> made;
  for (std::size_t i = 0; i < count; ++i) {
    support::Random random(seed * course_seed + 500 + i);
    Swinging bodies = passing(i < 2, random);
    made.push_back(course_among(fmt::format("{} {}", i < 2 ? "piston" : "solid", i), std::move(bodies),
                                radius_of(i, course_size), 1 + i % 2, share_of(ticks, count), random));
  }
  return made;
}

}  // namespace touchmark::bench::experiments::proxy
