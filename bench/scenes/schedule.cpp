#include "bench/scenes/schedule.h"

#include <fmt/format.h>

#include "bench/support/system/available_memory.h"

namespace touchmark::bench::scenes {

Schedule schedule_of(const BodyMotion& motion, std::span<const double> times_s) {
  Schedule schedule;
  if (motion.moving.empty()) return schedule;
  constexpr double copies = 2;  // here and in the memory that is shared with workers
  const double most = static_cast<double>(times_s.size()) * static_cast<double>(motion.moving.size());
  support::require_memory(fmt::format("{} steps of {} moving bodies", times_s.size(), motion.moving.size()),
                          copies * sizeof(BodyMove) * most);
  std::vector<Pose> poses(motion.moving.size());
  schedule.first.push_back(0);
  for (std::size_t step = 0; step < times_s.size(); ++step) {
    const bool whole = step % ScheduleView::whole_frame_every == 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Pose pose = pose_of(motion.at(motion.moving[i], times_s[step]));
      if (!whole && pose == poses[i]) continue;
      poses[i] = pose;
      schedule.moves.push_back(BodyMove::of(motion.moving[i], pose));
    }
    schedule.first.push_back(schedule.moves.size());
  }
  return schedule;
}

Schedule beginning(const Schedule& schedule, std::size_t steps) {
  if (schedule.first.size() <= steps + 1) return schedule;
  Schedule part;
  part.first.assign(schedule.first.begin(), schedule.first.begin() + static_cast<std::ptrdiff_t>(steps) + 1);
  part.moves.assign(schedule.moves.begin(),
                    schedule.moves.begin() + static_cast<std::ptrdiff_t>(part.first.back()));
  return part;
}

PlacedScene placed(const BodyScene& scene) {
  PlacedScene result{scene.shapes, {}};
  if (!scene.round.empty()) result.radii.resize(scene.shapes.size());
  for (const auto& [shape, round] : scene.round) {
    const double end = round.half_length;
    result.shapes[shape] = std::make_shared<const TriangleMesh>(
        std::vector<Vec3>{{0, 0, -end}, {0, 0, end}}, std::vector<TriangleMesh::Corners>{{0, 1, 1}});
    result.radii[shape] = round.radius;
  }
  result.bodies.reserve(scene.bodies.size());
  for (const Body& body : scene.bodies)
    result.bodies.push_back({static_cast<std::uint32_t>(body.shape), pose_of(body.start)});
  return result;
}

}  // namespace touchmark::bench::scenes
