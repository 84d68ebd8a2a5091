#include "bench/workload/workload.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/support/progress.h"
#include "bench/support/system/available_memory.h"
#include "bench/trajectories/trajectories.h"
#include "bench/workload/query_name.h"
#include "bench/workload/trace.h"

namespace touchmark::bench::workload {
namespace {

/// A recorded trajectory is replayed whole unless --steps says otherwise (0 stands for that).
std::size_t steps_of(const std::string& name, const Selection& selection, std::size_t default_steps) {
  if (selection.steps) return *selection.steps;
  return trajectories::is_generated(name) ? default_steps : 0;
}

/// In this process and the workers': a position, the step here, in the shared memory and there, and the
/// answer with its work.
constexpr std::size_t bytes_a_step = sizeof(Vec3) + 3 * sizeof(Step) + sizeof(Answer) + sizeof(std::uint64_t);

void require_memory_for(const std::vector<std::string>& trajectories, const Selection& selection,
                        std::size_t default_steps) {
  double steps = 0;
  for (const std::string& name : trajectories)
    steps += static_cast<double>(steps_of(name, selection, default_steps));
  support::require_memory(fmt::format("trajectory {}: {:.0f} steps", fmt::join(trajectories, ", "), steps),
                          steps * bytes_a_step);
}

void say_that_rows_are_steps(const trajectories::Trajectory& trajectory) {
  if (!trajectory.recorded || trajectory.recorded->resampled_hz) return;
  const std::optional<double> rate = trajectory.recorded->rate_hz();
  support::note_once(fmt::format(
      "{}: each row is a step, whatever the time ({}{:.6g} s); --rate HZ resamples by time", trajectory.name,
      rate ? fmt::format("{:.6g} Hz, ", *rate) : "", trajectory.recorded->duration_s));
}

void expect_a_motion_file(const std::vector<std::string>& trajectories,
                          const trajectories::MotionOptions& options) {
  if (options.are_given() && std::ranges::all_of(trajectories, &trajectories::is_generated))
    throw std::invalid_argument(
        fmt::format("{} is of motion files, and no --trajectory is one", options.columns   ? "--columns"
                                                                         : options.rate_hz ? "--rate"
                                                                         : options.drape   ? "--drape"
                                                                                         : "--motion-scale"));
}

}  // namespace

std::vector<Step> trace_along(const trajectories::Trajectory& trajectory, double radius,
                              std::optional<double> reach) {
  std::vector<Step> trace(trajectory.size());
  for (std::size_t i = 0; i < trace.size(); ++i) {
    trace[i].probe = {trajectory.positions[i], trajectory.radii.empty() ? radius : trajectory.radii[i]};
    trace[i].reach = reach.value_or(trace[i].probe.radius);
  }
  return trace;
}

Pace pace_of(const trajectories::Trajectory& trajectory) {
  Pace motion{0, 0, trajectory.recorded};
  double length = 0, duration = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const double piece = (trajectory.positions[i] - trajectory.positions[i - 1]).stableNorm();
    const double time = trajectory.times_s.empty() ? 1e-3 : trajectory.times_s[i] - trajectory.times_s[i - 1];
    length += piece;
    duration += time;
    motion.max_speed = std::max(motion.max_speed, piece / time);
  }
  if (duration > 0) motion.mean_speed = length / duration;
  return motion;
}

Workload make_workload(std::string mesh_name, TriangleMesh mesh, const Selection& selection,
                       const std::vector<std::string>& trajectories, std::size_t default_steps) {
  Workload workload{std::move(mesh_name), std::move(mesh), 0, {}, {}, {}};
  constexpr double bytes_a_triangle = 100;  // for sampling the surface, and the workers' copy
  support::require_memory(fmt::format("trajectories on {} triangles", workload.mesh.size()),
                          bytes_a_triangle * static_cast<double>(workload.mesh.size()));
  workload.radius = selection.radius.in_mesh_units(workload.mesh);
  if (selection.reach) workload.reach = selection.reach->in_mesh_units(workload.mesh);
  workload.unit = selection.unit;
  expect_a_motion_file(trajectories, selection.motion);
  require_memory_for(trajectories, selection, default_steps);
  for (const std::string& name : trajectories) {
    const trajectories::Trajectory trajectory =
        trajectories::make_trajectory(name, workload.mesh,
                                      {steps_of(name, selection, default_steps), selection.seed,
                                       workload.radius, selection.motion, selection.unit});
    say_that_rows_are_steps(trajectory);
    workload.motions.push_back(pace_of(trajectory));
    workload.trajectories.push_back(trajectory.name);
    workload.traces.push_back(trace_along(trajectory, workload.radius, workload.reach));
  }
  return workload;
}

std::string length_text(const Workload& workload, double length) {
  return workload.unit ? fmt::format("{:.6g} {}", length, workload.unit->name)
                       : fmt::format("{:.6g}", length);
}

std::string question_text(const Workload& workload, Query query) {
  const std::string bodies = workload.scene ? fmt::format("{} bodies, ", workload.scene->bodies.size()) : "";
  return fmt::format("{}: {}{} triangles, {} within {}, radius {}", workload.mesh_name, bodies,
                     workload.triangles(), name_of(query),
                     length_text(workload, workload.reach.value_or(workload.radius)),
                     length_text(workload, workload.radius));
}

std::string trace_text(const Workload& workload, std::size_t trace) {
  std::string text = fmt::format("{} steps", workload.traces[trace].size());
  if (trace >= workload.motions.size()) return text;
  const Pace& motion = workload.motions[trace];
  if (motion.recorded) {
    text += fmt::format(", {:.6g} s", motion.recorded->duration_s);
    if (const auto rate = motion.recorded->rate_hz()) text += fmt::format(" at {:.6g} Hz", *rate);
    if (const auto& rate = motion.recorded->resampled_hz)
      text += fmt::format(", resampled to {:.6g} Hz", *rate);
  }
  if (workload.unit)
    text += fmt::format(", mean speed {:.3g} m/s, at most {:.3g} m/s",
                        motion.mean_speed * workload.unit->metres, motion.max_speed * workload.unit->metres);
  return text;
}

}  // namespace touchmark::bench::workload
