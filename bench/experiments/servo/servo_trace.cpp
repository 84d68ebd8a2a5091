#include "bench/experiments/servo/servo_trace.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/trajectories/resampling.h"
#include "bench/trajectories/trajectories.h"

namespace touchmark::bench::experiments::servo {
namespace {

constexpr double shape_rate_hz = 1000;

void resample(std::vector<workload::Step>& trace, double rate_hz, std::size_t steps) {
  trajectories::Trajectory motion;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    motion.positions.push_back(trace[i].probe.center);
    motion.times_s.push_back(static_cast<double>(i) / shape_rate_hz);
  }
  const trajectories::Trajectory ticks = trajectories::resampled(motion, rate_hz, steps);
  workload::Step like = trace.front();
  trace.clear();
  for (const Vec3& position : ticks.positions) {
    like.probe.center = position;
    trace.push_back(like);
  }
}

std::size_t steps_for(const workload::Selection& selection, const ServoSettings& settings) {
  return selection.steps.value_or(
      static_cast<std::size_t>(std::min<std::uint64_t>(settings.ticks, default_steps)));
}

}  // namespace

bool is_resampled_shape(const std::string& trajectory, double rate_hz) {
  return trajectories::is_generated(trajectory) && rate_hz != shape_rate_hz;
}

workload::Selection selection_by_time(workload::Selection selection, const TriangleMesh& mesh,
                                      const std::string& trajectory, double rate_hz) {
  selection.motion.rate_hz.reset();
  if (trajectories::is_generated(trajectory)) return selection;
  const trajectories::Trajectory rows =
      trajectories::make_trajectory(trajectory, mesh, {0, selection.seed, 0, selection.motion});
  if (rows.recorded) selection.motion.rate_hz = rate_hz;
  return selection;
}

workload::Workload scene_workload_by_time(scenes::GeneratedScene scene, workload::Selection selection,
                                          const std::vector<std::string>& trajectories,
                                          const ServoSettings& settings) {
  for (const std::string& trajectory : trajectories) {
    if (is_resampled_shape(trajectory, settings.rate_hz))
      throw std::invalid_argument(fmt::format(
          "--rate {:g}: over a scene of bodies {} goes at {:g} Hz; a motion file goes at any rate",
          settings.rate_hz, trajectory, shape_rate_hz));
  }
  selection.motion.rate_hz = settings.rate_hz;
  return workload::make_scene_workload(std::move(scene), selection, trajectories,
                                       steps_for(selection, settings));
}

workload::Workload workload_by_time(std::string mesh_name, TriangleMesh mesh,
                                    const workload::Selection& selection, const std::string& trajectory,
                                    const ServoSettings& settings) {
  const std::size_t steps = steps_for(selection, settings);
  if (!is_resampled_shape(trajectory, settings.rate_hz))
    return workload::make_workload(std::move(mesh_name), std::move(mesh), selection, {trajectory}, steps);
  workload::Selection of_shape = selection;
  of_shape.steps =
      static_cast<std::size_t>(std::ceil(static_cast<double>(steps - 1) * shape_rate_hz / settings.rate_hz)) +
      1;
  workload::Workload workload =
      workload::make_workload(std::move(mesh_name), std::move(mesh), of_shape, {trajectory}, 0);
  resample(workload.traces.front(), settings.rate_hz, steps);
  return workload;
}

std::string motion_csv(const workload::Workload& workload) {
  std::string csv = "x,y,z\n";
  for (const workload::Step& step : workload.traces.front()) {
    const Vec3& at = step.probe.center;
    csv += fmt::format("{},{},{}\n", at.x(), at.y(), at.z());
  }
  return csv;
}

}  // namespace touchmark::bench::experiments::servo
