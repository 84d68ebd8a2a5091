/// A trajectory by time: where the hand is at each tick of a loop of any rate.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/scenes/generated_bodies.h"
#include "bench/workload/selection.h"
#include "bench/workload/workload.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::workload {

/// The ticks of a loop. A generated trajectory has a step for each, up to the default of `count`, unless more
/// steps are selected.
struct Ticks {
  double rate_hz = 1000;
  std::uint64_t count = 20'000;
};

/// What becomes of --rate for this trajectory: that of `selection` for a motion file with times, nothing for
/// another one, each of whose rows is a tick. Throws std::invalid_argument for a file that cannot be used.
Selection selection_by_time(Selection selection, const TriangleMesh& mesh, const std::string& trajectory,
                            double rate_hz);

/// Generated trajectories have a position each millisecond; at another rate they are resampled linearly.
/// Throws std::invalid_argument.
Workload workload_by_time(std::string mesh_name, TriangleMesh mesh, const Selection& selection,
                          const std::string& trajectory, const Ticks& ticks);

/// Likewise over bodies, which stand at each tick where they are by its time. Throws std::invalid_argument,
/// also for a generated trajectory at another rate than its own: it was made over bodies of other times.
Workload scene_workload_by_time(scenes::GeneratedScene scene, Selection selection,
                                const std::vector<std::string>& trajectories, const Ticks& ticks);

/// True if the steps of `touchmark query` are other ones, since the trajectory was resampled and is no file.
bool is_resampled_shape(const std::string& trajectory, double rate_hz);

/// The positions as a motion file.
std::string motion_csv(const Workload& workload);

}  // namespace touchmark::bench::workload
