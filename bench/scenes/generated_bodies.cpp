#include "bench/scenes/generated_bodies.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "bench/meshes/generated_meshes.h"
#include "bench/scenes/body_scene.h"
#include "bench/scenes/hashed_numbers.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::scenes {
namespace {

// How bodies move: kinds as in Broadmark (Serpa and Rodrigues, 2020), in closed form, so that a time has one
// pose whatever was asked before.

using Move = Placement (*)(const Placement& start, std::uint32_t body, double time_s);

/// Turns about an axis, by an angle whose half has the tangent `turn`.
Quaternion turned(const Quaternion& start, const Vec3& axis, double turn) {
  return product(normalized({1, turn * axis.x(), turn * axis.y(), turn * axis.z()}), start);
}

Vec3 vector_of(std::uint32_t body, std::uint32_t purpose) {
  const HashedNumbers random(body, purpose);
  return {random(0), random(1), random(2)};
}

/// A steady way in a direction of the body's own, at up to 0.1 diagonals a second, while it turns.
Placement drifting(const Placement& start, std::uint32_t body, double time_s) {
  return {start.position + 0.1 * time_s * vector_of(body, 4),
          turned(start.orientation, vector_of(body, 5), 0.2 * time_s)};
}

/// Falls and bounces between the start and one diagonal below it, each body in its own time of about a
/// second.
Placement falling(const Placement& start, std::uint32_t body, double time_s) {
  const HashedNumbers random(body, 6);
  const double period = 1 + 0.25 * random(0);
  const double part = time_s / period + random(1);
  const double flight = 2 * (part - std::floor(part)) - 1;
  return {start.position - flight * flight * Vec3::UnitZ(),
          turned(start.orientation, vector_of(body, 5), 0.2 * time_s)};
}

/// Smooth noise: hashed values at whole times, joined by 3 t^2 - 2 t^3.
double noise(std::uint32_t body, std::uint32_t purpose, double time) {
  const double whole = std::floor(time), t = time - whole;
  const HashedNumbers random(body, purpose);
  const double a = random(static_cast<std::uint64_t>(static_cast<std::int64_t>(whole)));
  const double b = random(static_cast<std::uint64_t>(static_cast<std::int64_t>(whole) + 1));
  return a + t * t * (3 - 2 * t) * (b - a);
}

/// Noise of many wavelengths, each half as high as it is slow: what Brownian motion has.
Vec3 brownian(std::uint32_t body, std::uint32_t purpose, double time_s) {
  Vec3 sum = Vec3::Zero();
  double frequency = 1, height = 0.1;  // hertz and diagonals
  for (std::uint32_t octave = 0; octave < 6; ++octave, frequency *= 4, height /= 2)
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      sum[static_cast<Eigen::Index>(axis)] +=
          height * noise(body, purpose + 3 * octave + axis, frequency * time_s);
  return sum;
}

Placement restless(const Placement& start, std::uint32_t body, double time_s) {
  constexpr std::uint32_t of_position = 16, of_orientation = 48;
  return {start.position + brownian(body, of_position, time_s),
          turned(start.orientation, brownian(body, of_orientation, time_s), 1)};
}

struct MotionKind {
  const char* name;
  const char* description;
  Move move;
  bool one = false;  ///< only the first body moves
};

constexpr MotionKind motion_kinds[] = {
    {"still", "no body moves; the default", nullptr},
    {"one", "the first body moves as in all, the others stand", restless, true},
    {"drift", "every body on a steady way of its own, turning", drifting},
    {"fall", "every body falls and bounces, turning", falling},
    {"all", "every body in Brownian motion, at all frequencies up to 1 kHz", restless},
};

/// Nothing where the name is of no motion. Lengths are in the diagonal of a body's box, which is 1.
std::optional<BodyMotion> generated_motion(const std::string& name, const BodyScene& scene) {
  const auto* const kind = std::ranges::find(motion_kinds, name, &MotionKind::name);
  if (kind == std::end(motion_kinds)) return std::nullopt;
  BodyMotion motion;
  if (kind->move == nullptr) return motion;
  motion.moving.resize(kind->one ? 1 : scene.bodies.size());
  std::iota(motion.moving.begin(), motion.moving.end(), 0U);
  std::vector<Placement> starts;
  for (const Body& body : scene.bodies) starts.push_back(body.start);
  motion.at = [shared = std::make_shared<const std::vector<Placement>>(std::move(starts)), move = kind->move](
                  std::uint32_t body, double time_s) { return move((*shared)[body], body, time_s); };
  return motion;
}

constexpr std::uint64_t max_bodies = 1'000'000;

/// One body's place, of so many bodies in all. Every shape has a box of diagonal 1 about the origin.
using Place = Placement (*)(std::uint32_t body, std::uint32_t side);

Quaternion any_orientation(std::uint32_t body) {
  const HashedNumbers random(body, 1);
  return normalized({random(0), random(1), random(2), random(3)});
}

Vec3 cell_of(std::uint32_t body, std::uint32_t side) {
  const double middle = 0.5 * (side - 1);
  return Vec3(body % side, body / side % side, body / side / side) - Vec3::Constant(middle);
}

Vec3 jitter(std::uint32_t body) {
  const HashedNumbers random(body, 2);
  return {random(0), random(1), random(2)};
}

/// Cells of edge 3 with bodies of at most 1: none is near another.
Placement in_field(std::uint32_t body, std::uint32_t side) {
  return {3 * cell_of(body, side) + 0.5 * jitter(body), any_orientation(body)};
}

/// Cells of edge 0.5 with bodies of 1: each is in contact with most of its neighbours.
Placement in_heap(std::uint32_t body, std::uint32_t side) {
  return {0.5 * cell_of(body, side) + 0.15 * jitter(body), any_orientation(body)};
}

/// Cubes in rows: faces 1e-6 of their edges apart, so that nothing but a hair is between neighbours.
Placement in_assembly(std::uint32_t body, std::uint32_t side) {
  const double edge = 1 / std::sqrt(3.0);
  return {edge * (1 + 1e-6) * cell_of(body, side), {1, 0, 0, 0}};
}

/// Anywhere: some overlap, some are alone, some are within others.
Placement in_cloud(std::uint32_t body, std::uint32_t side) {
  return {0.6 * side * jitter(body), any_orientation(body)};
}

struct Kind {
  const char* name;
  const char* description;
  Place place;
  bool cubes = false;
};

constexpr Kind kinds[] = {
    {"field", "N bodies far apart: none is near another", in_field},
    {"heap", "N bodies in contact with their neighbours, turned anyhow", in_heap},
    {"assembly", "N cubes in rows, 1e-6 of their edges apart", in_assembly, true},
    {"cloud", "N bodies anywhere: some overlap, some are alone", in_cloud},
};

std::vector<std::shared_ptr<const TriangleMesh>> shapes_of(const Kind& kind) {
  std::vector<std::shared_ptr<const TriangleMesh>> shapes;
  const auto add = [&](const TriangleMesh& mesh) {
    shapes.push_back(std::make_shared<const TriangleMesh>(mesh.normalized()));
  };
  add(meshes::cube());
  if (kind.cubes) return shapes;
  add(meshes::icosphere(2));
  add(meshes::torus(24, 12));
  add(meshes::wedge());
  add(meshes::noisy_sphere(1000));
  return shapes;
}

std::invalid_argument wrong(const std::string& what, const std::string& why) {
  return std::invalid_argument(fmt::format("scene \"{}\": {}", what, why));
}

std::uint32_t checked_count(const std::string& what, std::string_view text) {
  const std::optional<std::uint64_t> count = support::parse_count(text);
  if (!count || *count < 1 || *count > max_bodies)
    throw wrong(what, fmt::format("\"{}\" is not a number of bodies from 1 to {}", text, max_bodies));
  return static_cast<std::uint32_t>(*count);
}

BodyScene made(const Kind& kind, const std::string& what, std::uint32_t count) {
  BodyScene scene{what, shapes_of(kind), {}};
  scene.bodies.reserve(count);
  std::uint32_t side = 1;
  while (std::uint64_t{side} * side * side < count) ++side;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t shape = HashedNumbers(i, 3).below(scene.shapes.size());
    scene.bodies.push_back({fmt::format("body{}", i), shape, kind.place(i, side)});
  }
  return scene;
}

}  // namespace

std::vector<BodySceneInfo> body_motions() {
  std::vector<BodySceneInfo> infos;
  for (const MotionKind& kind : motion_kinds) infos.push_back({kind.name, kind.description});
  return infos;
}

std::vector<BodySceneInfo> body_scenes() {
  std::vector<BodySceneInfo> infos;
  for (const Kind& kind : kinds) infos.push_back({fmt::format("{}:N", kind.name), kind.description});
  return infos;
}

std::optional<GeneratedScene> generated_scene(const std::string& what) {
  const std::size_t colon = what.find(':');
  const auto* const kind = std::ranges::find(kinds, what.substr(0, colon), &Kind::name);
  if (kind == std::end(kinds)) return std::nullopt;
  if (colon == std::string::npos) throw wrong(what, fmt::format("write {}:N, N bodies", kind->name));
  const std::string parameters = what.substr(colon + 1);
  const std::size_t next = parameters.find(':');
  std::string motion = "still";
  if (next != std::string::npos) {
    constexpr std::string_view key = "motion=";
    const std::string_view option = std::string_view(parameters).substr(next + 1);
    if (!option.starts_with(key)) throw wrong(what, fmt::format("\"{}\" is not motion=NAME", option));
    motion = option.substr(key.size());
  }
  GeneratedScene generated{made(*kind, what, checked_count(what, parameters.substr(0, next))), {}};
  std::optional<BodyMotion> moved = generated_motion(motion, generated.scene);
  if (!moved) {
    std::vector<std::string> names;
    for (const BodySceneInfo& known : body_motions()) names.push_back(known.name);
    throw wrong(what, fmt::format("\"{}\" is no motion; it is one of {}", motion, fmt::join(names, ", ")));
  }
  generated.motion = *std::move(moved);
  return generated;
}

}  // namespace touchmark::bench::scenes
