#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/support/system/available_memory.h"
#include "bench/trajectories/trajectories.h"
#include "bench/workload/trace.h"
#include "bench/workload/workload.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/scene/moving/moving_body.h"

namespace touchmark::bench::workload {
namespace {

constexpr double default_rate_hz = 1000;
constexpr std::size_t max_merged_triangles = 2'000'000;
/// Poses of all steps are kept: of so many bodies that move fewer steps are the default.
constexpr std::size_t max_default_poses = 2'000'000, min_default_steps = 32;

std::size_t affordable(std::size_t steps, std::size_t moving) {
  if (steps == 0 || moving == 0) return steps;
  return std::min(steps, std::max(max_default_poses / moving, min_default_steps));
}

std::vector<double> times_of(const trajectories::Trajectory& trajectory, std::optional<double> rate_hz) {
  if (!trajectory.times_s.empty()) return trajectory.times_s;
  std::vector<double> times(trajectory.size());
  for (std::size_t i = 0; i < times.size(); ++i)
    times[i] = static_cast<double>(i) / rate_hz.value_or(default_rate_hz);
  return times;
}

/// The bodies of the merged mesh, by the triangles that each begins with.
std::vector<std::size_t> beginnings_of(const scenes::BodyScene& scene, std::size_t triangles) {
  std::vector<std::size_t> beginnings;
  std::size_t sum = 0;
  for (const scenes::Body& body : scene.bodies) {
    if (sum >= triangles) break;
    beginnings.push_back(sum);
    sum += scene.shapes[body.shape]->size();
  }
  return beginnings;
}

/// Takes each position along with the body nearest to it at the start.
void carry(std::vector<Vec3>& positions, std::span<const double> times, const scenes::GeneratedScene& scene,
           const TriangleMesh& merged) {
  if (scene.motion.moving.empty()) return;
  const std::vector<std::size_t> beginnings = beginnings_of(scene.scene, merged.size());
  const AabbTree tree = AabbTree::build(merged, {});
  AabbTree::Session session;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto found = tree.nearest({positions[i], 0}, std::numeric_limits<double>::infinity(), session);
    if (!found) continue;
    const auto after = std::ranges::upper_bound(beginnings, found->triangle);
    const auto body = static_cast<std::uint32_t>(after - beginnings.begin() - 1);
    if (!std::ranges::binary_search(scene.motion.moving, body)) continue;
    const Pose start = scenes::pose_of(scene.scene.bodies[body].start);
    positions[i] = image(scenes::pose_of(scene.motion.at(body, times[i])), in_frame(start, positions[i]));
  }
}

/// Throws std::invalid_argument for a body that turns too far in a step to be asked about on its way.
void expect_moving(const scenes::Schedule& schedule) try {
  std::map<std::uint64_t, Pose> poses;
  for (const scenes::BodyMove& move : schedule.moves) {
    const auto [before, is_first] = poses.try_emplace(move.body, move.pose());
    if (!is_first) MovingBody({static_cast<std::uint32_t>(move.body), 0}, before->second, move.pose());
    before->second = move.pose();
  }
} catch (const PoseError& error) {
  throw std::invalid_argument(error.what());
}

}  // namespace

Workload make_scene_workload(scenes::GeneratedScene scene, const Selection& selection,
                             const std::vector<std::string>& trajectories, std::size_t default_steps) {
  const double diagonal = scenes::bounds_of(scene.scene).diagonal();
  Workload workload{scene.scene.name, scenes::merged(scene.scene, max_merged_triangles), 0, {}, {}, {}};
  workload.radius = selection.radius.along(diagonal);
  if (selection.reach) workload.reach = selection.reach->along(diagonal);
  workload.unit = selection.unit;
  trajectories::MotionOptions motion = selection.motion;
  motion.of_a_scene = true;
  const std::size_t steps = affordable(default_steps, scene.motion.moving.size());
  for (const std::string& name : trajectories) {
    const bool generated = trajectories::is_generated(name);
    trajectories::Trajectory trajectory =
        trajectories::make_trajectory(name, workload.mesh,
                                      {selection.steps.value_or(generated ? steps : 0), selection.seed,
                                       workload.radius, motion, selection.unit});
    const std::vector<double> times = times_of(trajectory, selection.motion.rate_hz);
    if (generated || motion.drape) carry(trajectory.positions, times, scene, workload.mesh);
    workload.motions.push_back(pace_of(trajectory));
    workload.trajectories.push_back(trajectory.name);
    workload.traces.push_back(trace_along(trajectory, workload.radius, workload.reach));
    workload.schedules.push_back(scenes::schedule_of(scene.motion, times));
    if (std::ranges::find(selection.queries, Query::moving) != selection.queries.end())
      expect_moving(workload.schedules.back());
  }
  workload.scene = std::make_shared<const scenes::BodyScene>(std::move(scene.scene));
  return workload;
}

}  // namespace touchmark::bench::workload
