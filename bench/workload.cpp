#include "bench/workload.h"

#include <algorithm>
#include <utility>

#include "bench/trajectories.h"

namespace touchmark::bench {
namespace {

std::vector<Step> course_along(const Trajectory& trajectory, double radius, std::optional<double> reach) {
  std::vector<Step> course(trajectory.size());
  for (std::size_t i = 0; i < course.size(); ++i) {
    course[i].probe = {trajectory.positions[i], trajectory.radii.empty() ? radius : trajectory.radii[i]};
    course[i].reach = reach.value_or(course[i].probe.radius);
  }
  return course;
}

/// A recorded trajectory is replayed whole unless --steps says otherwise (0 stands for that).
std::size_t steps_of(const std::string& name, const Selection& selection, std::size_t default_steps) {
  if (selection.steps) return *selection.steps;
  const std::vector<TrajectoryInfo> generated = trajectories();
  const bool is_generated = std::any_of(generated.begin(), generated.end(),
                                        [&](const TrajectoryInfo& info) { return info.name == name; });
  return is_generated ? default_steps : 0;
}

}  // namespace

Workload make_workload(std::string mesh_name, TriangleMesh mesh, const Selection& selection,
                       const std::vector<std::string>& trajectories, std::size_t default_steps) {
  Workload workload{std::move(mesh_name), std::move(mesh), 0, {}, {}, {}};
  workload.radius = selection.radius.in_mesh_units(workload.mesh);
  if (selection.reach) workload.reach = selection.reach->in_mesh_units(workload.mesh);
  for (const std::string& name : trajectories) {
    const Trajectory trajectory = make_trajectory(
        name, workload.mesh, {steps_of(name, selection, default_steps), selection.seed, workload.radius});
    workload.trajectories.push_back(trajectory.name);
    workload.courses.push_back(course_along(trajectory, workload.radius, workload.reach));
  }
  return workload;
}

}  // namespace touchmark::bench
