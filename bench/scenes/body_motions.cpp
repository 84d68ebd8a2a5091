#include "bench/scenes/body_motions.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "bench/scenes/generated_bodies.h"
#include "bench/scenes/hashed_numbers.h"

namespace touchmark::bench::scenes {
namespace {

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

}  // namespace

std::vector<BodySceneInfo> body_motions() {
  std::vector<BodySceneInfo> infos;
  for (const MotionKind& kind : motion_kinds) infos.push_back({kind.name, kind.description});
  return infos;
}

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

}  // namespace touchmark::bench::scenes
