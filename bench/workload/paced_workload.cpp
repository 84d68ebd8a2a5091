#include "bench/workload/paced_workload.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/trajectories/resampling.h"
#include "bench/trajectories/trajectories.h"

namespace touchmark::bench::workload {
namespace {

constexpr double shape_rate_hz = 1000;

void resample(std::vector<Step>& trace, double rate_hz, std::size_t steps) {
  trajectories::Trajectory motion;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    motion.positions.push_back(trace[i].probe.center);
    motion.times_s.push_back(static_cast<double>(i) / shape_rate_hz);
  }
  const trajectories::Trajectory resampled = trajectories::resampled(motion, rate_hz, steps);
  Step like = trace.front();
  trace.clear();
  for (const Vec3& position : resampled.positions) {
    like.probe.center = position;
    trace.push_back(like);
  }
}

std::size_t steps_for(const Selection& selection, const Ticks& ticks) {
  return selection.steps.value_or(
      static_cast<std::size_t>(std::min<std::uint64_t>(ticks.count, Ticks().count)));
}

}  // namespace

bool is_resampled_shape(const std::string& trajectory, double rate_hz) {
  return trajectories::is_generated(trajectory) && rate_hz != shape_rate_hz;
}

Selection selection_by_time(Selection selection, const TriangleMesh& mesh, const std::string& trajectory,
                            double rate_hz) {
  selection.motion.rate_hz.reset();
  if (trajectories::is_generated(trajectory)) return selection;
  const trajectories::Trajectory rows =
      trajectories::make_trajectory(trajectory, mesh, {0, selection.seed, 0, selection.motion});
  if (rows.recorded) selection.motion.rate_hz = rate_hz;
  return selection;
}

Workload scene_workload_by_time(scenes::GeneratedScene scene, Selection selection,
                                const std::vector<std::string>& trajectories, const Ticks& ticks) {
  for (const std::string& trajectory : trajectories)
    if (is_resampled_shape(trajectory, ticks.rate_hz))
      throw std::invalid_argument(fmt::format(
          "--rate {:g}: over a scene of bodies {} goes at {:g} Hz; a motion file goes at any rate",
          ticks.rate_hz, trajectory, shape_rate_hz));
  selection.motion.rate_hz = ticks.rate_hz;
  return make_scene_workload(std::move(scene), selection, trajectories, steps_for(selection, ticks));
}

Workload workload_by_time(std::string mesh_name, TriangleMesh mesh, const Selection& selection,
                          const std::string& trajectory, const Ticks& ticks) {
  const std::size_t steps = steps_for(selection, ticks);
  if (!is_resampled_shape(trajectory, ticks.rate_hz))
    return make_workload(std::move(mesh_name), std::move(mesh), selection, {trajectory}, steps);
  Selection of_shape = selection;
  of_shape.steps =
      static_cast<std::size_t>(std::ceil(static_cast<double>(steps - 1) * shape_rate_hz / ticks.rate_hz)) + 1;
  Workload workload = make_workload(std::move(mesh_name), std::move(mesh), of_shape, {trajectory}, 0);
  resample(workload.traces.front(), ticks.rate_hz, steps);
  return workload;
}

std::string motion_csv(const Workload& workload) {
  std::string csv = "x,y,z\n";
  for (const Step& step : workload.traces.front()) {
    const Vec3& at = step.probe.center;
    csv += fmt::format("{},{},{}\n", at.x(), at.y(), at.z());
  }
  return csv;
}

}  // namespace touchmark::bench::workload
