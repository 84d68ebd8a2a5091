#include "bench/experiments/proxy/stab.h"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/proxy/motion.h"
#include "bench/experiments/proxy/proxy_run.h"
#include "bench/meshes/surface_builder.h"

namespace touchmark::bench::experiments::proxy {
namespace {

struct Place {
  double x, z;
};

/// The cut's outline, counter-clockwise, so that faces look outwards.
constexpr std::array outline{Place{-0.05, -0.02},    Place{0.03, -0.02}, Place{0.03, 0.03},
                             Place{0.0295, 0.03},    Place{0.0295, 0},   Place{0, 0},
                             Place{-0.0125, -0.015}, Place{-0.025, 0},   Place{-0.05, 0}};

constexpr double radius = 0.002;

}  // namespace

Course stab_course() {
  meshes::Surface surface;
  constexpr double half = 0.05;
  for (const Place& place : outline) {
    surface.add(Vec3(place.x, -half, place.z));
    surface.add(Vec3(place.x, half, place.z));
  }
  constexpr auto count = static_cast<std::uint32_t>(outline.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    surface.quad(2 * i, 2 * i + 1, 2 * next + 1, 2 * next);
  }
  const Vec3 start(-0.045, 0, 0.02);
  Motion motion(start, 60);
  motion.line(Vec3(-0.04, 0, -0.012), 8);
  motion.line(Vec3(0.015, 0, -0.014), 24);
  motion.line(Vec3(0.02, 0, 0.012), 6);
  motion.line(Vec3(0.05, 0, 0.014), 2);
  motion.rest(12);
  return {"stab", std::move(surface).mesh(), radius, 0, start, std::move(motion).take()};
}

std::string stab_csv(const contestants::Roster& roster, const std::vector<MethodSpec>& methods,
                     const Coupling& coupling, const std::string& detector) {
  const Course course = stab_course();
  std::string text = "method,step,goal_x,goal_z,proxy_x,proxy_z\n";
  for (std::size_t i = 0; i <= outline.size(); ++i) {
    const Place& place = outline[i % outline.size()];
    text += fmt::format("surface,{},,,{},{}\n", i, place.x, place.z);
  }
  for (const MethodSpec& method : methods) {
    Coupling of_it = coupling;
    of_it.radius = method.info->points_only ? 0 : course.radius;
    Tally tally;
    run_course(roster, course, {}, method, of_it, detector, tally,
               [&](std::size_t tick, const Step& step, std::int64_t) {
                 const Vec3& goal = course.goals[tick];
                 for (std::size_t i = step.way.size() > 1 ? 1 : 0; i < step.way.size(); ++i)
                   text += fmt::format("\"{}\",{},{},{},{},{}\n", method.text(), tick, goal.x(), goal.z(),
                                       step.way[i].x(), step.way[i].z());
               });
  }
  return text;
}

}  // namespace touchmark::bench::experiments::proxy
