#include "bench/experiments/many/many_workload.h"

#include <array>
#include <utility>

#include <Eigen/Geometry>

#include "bench/support/names.h"
#include "bench/support/random.h"
#include "bench/trajectories/surface.h"
#include "bench/trajectories/trajectories.h"

namespace touchmark::bench::experiments::many {
namespace {

using trajectories::Surface, trajectories::SurfacePoint;

constexpr std::array<support::Name<Kind>, 4> names{{{Kind::coherent, "coherent"},
                                                    {Kind::incoherent, "incoherent"},
                                                    {Kind::pointshell, "pointshell"},
                                                    {Kind::pointshell_close, "pointshell-close"}}};

std::vector<Vec3> within_reach(const Surface& surface, double reach, std::size_t count,
                               support::Random& random) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const SurfacePoint place = surface.random_surface_point(random);
    points.push_back(place.point + random.between(-reach, reach) * place.normal);
  }
  return points;
}

/// Points of a body in its own frame, whose origin is the middle of the mesh's box.
std::vector<Vec3> points_of_body(const Surface& surface, const Vec3& middle, std::size_t count,
                                 support::Random& random) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(surface.random_surface_point(random).point - middle);
  return points;
}

std::vector<Vec3> posed(const std::vector<Vec3>& body, double scale, double angle, const Vec3& at) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vec3> points;
  for (const Vec3& point : body) points.push_back(scale * (turn * point) + at);
  return points;
}

/// A body comes down from where its box's ball is clear of the place to where it would be half within.
std::vector<std::vector<Vec3>> coming_down(const std::vector<Vec3>& body, const SurfacePoint& place,
                                           double diagonal, std::size_t ticks) {
  constexpr double scale = 0.25, turn_a_tick = 2e-4;
  std::vector<std::vector<Vec3>> calls;
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    const double way = static_cast<double>(tick) / static_cast<double>(ticks);
    const Vec3 at = place.point + 0.5 * scale * diagonal * (1 - 0.5 * way) * place.normal;
    calls.push_back(posed(body, scale, turn_a_tick * static_cast<double>(tick), at));
  }
  return calls;
}

/// To and fro by half the reach along each of two axes, which leaves every point within reach of its place.
std::vector<std::vector<Vec3>> shaken(const std::vector<Vec3>& body, const Vec3& middle, double reach,
                                      std::size_t ticks) {
  constexpr std::size_t period = 100;
  std::vector<std::vector<Vec3>> calls;
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    const auto wave = [&](std::size_t phase) {
      const auto at = static_cast<double>((tick + phase) % period) / period;
      return at < 0.5 ? 4 * at - 1 : 3 - 4 * at;
    };
    calls.push_back(posed(body, 1, 0, middle + 0.5 * reach * Vec3(wave(0), wave(period / 4), 0)));
  }
  return calls;
}

}  // namespace

std::string_view name_of(Kind kind) noexcept { return support::name_in(names, kind); }

std::optional<Kind> kind_named(std::string_view text) noexcept {
  return support::value_in<Kind>(names, text);
}

Workload make_workload(Kind kind, const TriangleMesh& mesh, double reach, const WorkloadSizes& sizes,
                       std::uint64_t seed) {
  const Surface surface(mesh);
  support::Random random(seed);
  const Vec3 middle = 0.5 * mesh.bounds().min + 0.5 * mesh.bounds().max;
  Workload workload{kind, reach, {}};
  switch (kind) {
    case Kind::coherent:
      workload.calls.push_back(
          trajectories::make_trajectory("slide", mesh, {sizes.points, seed, reach}).positions);
      break;
    case Kind::incoherent:
      workload.calls.push_back(within_reach(surface, reach, sizes.points, random));
      break;
    case Kind::pointshell: {
      const SurfacePoint place = surface.random_surface_point(random);
      workload.calls = coming_down(points_of_body(surface, middle, sizes.shell_points, random), place,
                                   mesh.diagonal(), sizes.ticks);
      break;
    }
    case Kind::pointshell_close:
      workload.calls =
          shaken(points_of_body(surface, middle, sizes.shell_points, random), middle, reach, sizes.ticks);
      break;
  }
  return workload;
}

}  // namespace touchmark::bench::experiments::many
