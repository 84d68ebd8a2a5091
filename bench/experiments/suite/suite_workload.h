/// The workload of one scene of the suite: each motion and reach once, whatever is asked along it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/experiments/suite/suite_plan.h"
#include "bench/workload/workload.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::suite {

struct SceneWorkload {
  workload::Workload workload;
  std::vector<std::size_t> trace_of;  ///< one a cell of the scene
};

/// Throws std::invalid_argument or ResourceError.
SceneWorkload workload_of(const SuiteScene& scene, const TriangleMesh& mesh, std::size_t steps,
                          std::uint64_t seed);

}  // namespace touchmark::bench::experiments::suite
