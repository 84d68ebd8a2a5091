#include "bench/experiments/scaling/body_question.h"

#include <algorithm>
#include <cstdint>

#include "bench/meshes/portable_sincos.h"
#include "bench/support/system/available_memory.h"

namespace touchmark::bench::experiments::scaling {
namespace {

constexpr double frame_s = BodyQuestion::ticks_a_frame / 1000.0;  // a servo tick is a millisecond

/// A few thousandths of a body's size about the place, along a curve that never stands still.
Vec3 wobble(std::size_t tick) {
  const double t = static_cast<double>(tick);
  return 0.003 * Vec3(meshes::portable_sincos(t / 97).cos, meshes::portable_sincos(t / 61).sin,
                      meshes::portable_sincos(t / 43).sin);
}

/// Outside all bodies of a field and more than one body's size from each; or just outside the first body,
/// that it moves with.
Vec3 place_of(Place place, const scenes::GeneratedScene& scene, double time_s) {
  const scenes::Body& first = scene.scene.bodies.front();
  if (place == Place::free) return first.start.position + Vec3::Constant(1.5);
  const bool moves = !scene.motion.moving.empty() && scene.motion.moving.front() == 0;
  const Pose pose = scenes::pose_of(moves ? scene.motion.at(0, time_s) : first.start);
  return image(pose, 1.02 * scene.scene.shapes[first.shape]->vertices().front());
}

}  // namespace

BodyQuestion::BodyQuestion(const scenes::GeneratedScene& scene, Place where) : place(where) {
  const std::vector<std::uint32_t>& moving = scene.motion.moving;
  if (!moving.empty()) {
    support::require_memory("the poses of bodies",
                            2 * sizeof(scenes::BodyMove) * static_cast<double>(frames * moving.size()));
    schedule.first.push_back(0);
  }
  for (std::size_t frame = 0; frame < frames; ++frame) {
    // There and back again, so that the way from the last to the first is no jump.
    const double time_s = frame_s * static_cast<double>(std::min(frame, frames - frame));
    for (const std::uint32_t body : moving)
      schedule.moves.push_back(scenes::BodyMove::of(body, scenes::pose_of(scene.motion.at(body, time_s))));
    for (std::size_t tick = 0; tick < ticks_a_frame; ++tick) {
      if (!moving.empty()) schedule.first.push_back(schedule.moves.size());
      const Vec3 center = place_of(place, scene, time_s) + wobble(frame * ticks_a_frame + tick);
      workload::Step step;
      step.probe = {center, reach};
      step.reach = reach;
      steps.push_back(step);
    }
  }
  view = schedule.view();
  moved = moving.size();
}

workload::QueryTrace BodyQuestion::trace() const {
  return {workload::Query::nearest, steps, schedule.first.empty() ? nullptr : &view};
}

}  // namespace touchmark::bench::experiments::scaling
