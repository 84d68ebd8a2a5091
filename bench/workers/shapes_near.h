/// Which shapes of a scene some probe of its traces comes near, so that the others need not be built.
#pragma once

#include <span>
#include <vector>

#include "bench/scenes/schedule.h"
#include "bench/workload/steps.h"

namespace touchmark::bench::workers {

/// Returns for each shape whether one of its bodies, by its box, may be within the radius of a probe's way or
/// among the nearest within its reach, at a step of a trace. There is a schedule for each trace.
std::vector<bool> shapes_near(const scenes::PlacedScene& scene,
                              std::span<const std::vector<workload::Step>> traces,
                              std::span<const scenes::ScheduleView> schedules);

}  // namespace touchmark::bench::workers
