/// How long a detector takes to follow its mesh, against building it anew. Runs in a worker.
#pragma once

#include <chrono>

#include "bench/contestants/roster.h"
#include "bench/meshes/deformation.h"
#include "bench/workers/worker_protocol.h"

namespace touchmark::bench::workers {

using Clock = std::chrono::steady_clock;

inline double ns_since(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

/// Times updates from `rest` to the deformed mesh and back, in turn with builds of the deformed mesh. The
/// contestant, which must be one that updates, follows the deformed mesh afterwards.
Updated time_updates(contestants::Contestant& contestant, const contestants::Roster& roster,
                     const contestants::ContestantSpec& spec, const TriangleMesh& rest,
                     const meshes::Deformation& deformation);

}  // namespace touchmark::bench::workers
