// Courses among surfaces that deform: so far within a tick that they pass the probe.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/experiments/proxy/course_makers.h"

namespace touchmark::bench::experiments::proxy {
namespace {

/// A surface after so many changes, and where a probe is that it does not enclose or hold between its parts.
struct Deforming {
  std::function<TriangleMesh(std::size_t change)> mesh;
  Vec3 start = Vec3(0, 0, 1.5 * course_size);
};

/// Adds a sheet about the middle, as wide as the box of a piston. `at` moves its points off the plane z = 0.
template <class At>
void add_sheet(meshes::Surface& surface, const At& at) {
  meshes::add_patch(surface, 8, 8, [&](double u, double v) {
    return at(Vec3((2 * u - 1) * course_size, (2 * v - 1) * course_size, 0));
  });
}

template <class At>
TriangleMesh sheet(const At& at) {
  meshes::Surface surface;
  add_sheet(surface, at);
  return std::move(surface).mesh();
}

Swing any_swing(support::Random& random, double longest = 6) {
  return {random.between(2.2, longest), random.unit()};
}

constexpr double high = 0.9 * course_size;

Deforming level(double, support::Random& random) {
  return {[up = any_swing(random)](std::size_t change) {
    return sheet([&](const Vec3& at) { return Vec3(at + high * up.at(change) * Vec3::UnitZ()); });
  }};
}

/// It bends up and down, and leans over.
Deforming bowl(double, support::Random& random) {
  return {[up = any_swing(random), bend = any_swing(random, 20),
           lean = any_swing(random, 20)](std::size_t change) {
    const double height = high * up.at(change), bent = 0.5 / course_size * bend.at(change),
                 slope = 0.3 * lean.at(change);
    return sheet([&](const Vec3& at) {
      return Vec3(at.x(), at.y(), height + bent * at.squaredNorm() + slope * at.x());
    });
  }};
}

/// Each corner goes its own way.
Deforming waves(double, support::Random& random) {
  return {[up = any_swing(random), seed = random.below(1'000'000)](std::size_t change) {
    support::Random shake(seed + change);
    return sheet([&](const Vec3& at) {
      return Vec3(at + high * up.at(change) * Vec3::UnitZ() + 0.08 * course_size * shake.point());
    });
  }};
}

/// A side of the box that the probe is in.
Deforming piston(double, support::Random& random) {
  return {[up = any_swing(random)](std::size_t change) {
    meshes::Surface box;
    meshes::add_box(box, Vec3(-course_size, -course_size, high * up.at(change)),
                    Vec3(course_size, course_size, 2 * course_size));
    return std::move(box).mesh();
  }};
}

/// Two sheets that go up and down with the probe between them, and close to a gap that is wider than the
/// ball.
Deforming press(double radius, support::Random& random) {
  const double least = random.between(1.2, 3) * radius + 0.002 * course_size;
  const Swing up = any_swing(random), wide = any_swing(random, 20);
  return {[=](std::size_t change) {
            const double gap = least + 5 * least * (1 - wide.at(change));
            meshes::Surface both;
            for (const double side : {-1.0, 1.0})
              add_sheet(both, [&](const Vec3& at) {
                return Vec3(at.x(), at.y(), high * (up.at(change) - up.at(0)) / 2 + side * gap);
              });
            return std::move(both).mesh();
          },
          Vec3::Zero()};
}

struct Kind {
  std::string_view name;
  Deforming (*make)(double radius, support::Random& random);
};
constexpr std::array kinds{Kind{"sheet", &level}, Kind{"bowl", &bowl}, Kind{"waves", &waves},
                           Kind{"piston", &piston}, Kind{"press", &press}};

}  // namespace

std::vector<Course> passing_sheets(std::uint64_t seed, std::size_t ticks) {
  constexpr std::size_t count = 2 * kinds.size();
  std::vector<Course> made;
  for (std::size_t i = 0; i < count; ++i) {
    support::Random random(seed * course_seed + 520 + i);
    const Kind& kind = kinds.at(i / 2);
    const double radius = radius_of(i, course_size);
    Deforming surface = kind.make(radius, random);
    made.push_back({fmt::format("{} {}", kind.name, i), surface.mesh(0), radius, 0, surface.start,
                    about_the_middle(surface.start, share_of(ticks, count), random)});
    made.back().update_every = 1 + random.below(2);
    made.back().moved = std::move(surface.mesh);
  }
  return made;
}

}  // namespace touchmark::bench::experiments::proxy
