/// What a workload takes of a trajectory, of one mesh or of a scene.
#pragma once

#include <optional>
#include <vector>

#include "bench/workload/workload.h"

namespace touchmark::bench::workload {

/// A step is a millisecond where no times say otherwise.
Pace pace_of(const trajectories::Trajectory& trajectory);

/// `radius` is of trajectories that bring none; without a reach it is each probe's radius.
std::vector<Step> trace_along(const trajectories::Trajectory& trajectory, double radius,
                              std::optional<double> reach);

}  // namespace touchmark::bench::workload
