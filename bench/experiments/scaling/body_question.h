/// What a scene of bodies is asked: frames of poses, and some ticks after each.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/experiments/scaling/body_row.h"
#include "bench/scenes/generated_bodies.h"
#include "bench/scenes/schedule.h"
#include "bench/workload/steps.h"

namespace touchmark::bench::experiments::scaling {

/// The steps of a trace: a frame's first one places the bodies, the others nothing.
struct BodyQuestion {
  /// Every scene is asked as much as the others, at the same places.
  static constexpr std::size_t ticks_a_frame = 16, frames = 16;
  static constexpr double reach = 0.05;  ///< In body sizes.

  /// Throws ResourceError where the poses do not fit in memory.
  BodyQuestion(const scenes::GeneratedScene& scene, Place where);
  BodyQuestion(const BodyQuestion&) = delete;
  BodyQuestion& operator=(const BodyQuestion&) = delete;

  /// It looks at this question, which outlives it.
  workload::QueryTrace trace() const;

  Place place;
  std::size_t moved = 0;
  scenes::Schedule schedule;
  scenes::ScheduleView view;
  std::vector<workload::Step> steps;
};

}  // namespace touchmark::bench::experiments::scaling
