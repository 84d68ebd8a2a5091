/// The motions that candidates are measured on.
#pragma once

#include <string>
#include <vector>

#include "bench/scenes/generated_bodies.h"
#include "bench/workload/selection.h"
#include "bench/workload/workload.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::choose {

/// All motions by time, a position a tick of the rate; names of trajectories, of files, or fast-slide, which
/// is slide ten times as fast. Throws std::invalid_argument.
workload::Workload workload_by_time(const std::string& mesh_name, const TriangleMesh& mesh,
                                    const workload::Selection& selection,
                                    const std::vector<std::string>& motions, double rate_hz);
/// Over bodies, which move in the meantime. Throws std::invalid_argument, also for a generated
/// motion at another rate than 1000.
workload::Workload workload_by_time(scenes::GeneratedScene scene, const workload::Selection& selection,
                                    const std::vector<std::string>& motions, double rate_hz);

}  // namespace touchmark::bench::experiments::choose
