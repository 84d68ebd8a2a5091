#include "bench/workload.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "bench/available_memory.h"
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

/// In this process and the workers': a position, the step here, in the shared memory and there, and the
/// answer with its work.
constexpr std::size_t bytes_a_step = sizeof(Vec3) + 3 * sizeof(Step) + sizeof(Answer) + sizeof(std::uint64_t);

void require_memory_for(const std::vector<std::string>& trajectories, const Selection& selection,
                        std::size_t default_steps) {
  double steps = 0;
  for (const std::string& name : trajectories)
    steps += static_cast<double>(steps_of(name, selection, default_steps));
  require_memory(fmt::format("trajectory {}: {:.0f} steps", fmt::join(trajectories, ", "), steps),
                 steps * bytes_a_step);
}

}  // namespace

Workload make_workload(std::string mesh_name, TriangleMesh mesh, const Selection& selection,
                       const std::vector<std::string>& trajectories, std::size_t default_steps) {
  Workload workload{std::move(mesh_name), std::move(mesh), 0, {}, {}, {}};
  constexpr double bytes_a_triangle = 100;  // for sampling the surface, and the workers' copy
  require_memory(fmt::format("trajectories on {} triangles", workload.mesh.size()),
                 bytes_a_triangle * static_cast<double>(workload.mesh.size()));
  workload.radius = selection.radius.in_mesh_units(workload.mesh);
  if (selection.reach) workload.reach = selection.reach->in_mesh_units(workload.mesh);
  require_memory_for(trajectories, selection, default_steps);
  for (const std::string& name : trajectories) {
    const Trajectory trajectory = make_trajectory(
        name, workload.mesh, {steps_of(name, selection, default_steps), selection.seed, workload.radius});
    workload.trajectories.push_back(trajectory.name);
    workload.courses.push_back(course_along(trajectory, workload.radius, workload.reach));
  }
  return workload;
}

}  // namespace touchmark::bench
