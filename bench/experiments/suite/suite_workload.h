/// The workload of one mesh of the suite: each motion and reach once, whatever is asked along it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/experiments/suite/suite_plan.h"
#include "bench/workload/workload.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::suite {

struct MeshWorkload {
  workload::Workload workload;
  std::vector<std::size_t> trace_of;  ///< one a cell of the mesh
};

/// Throws std::invalid_argument or ResourceError.
MeshWorkload workload_of(const SuiteMesh& planned, const TriangleMesh& mesh, std::size_t steps,
                         std::uint64_t seed);

}  // namespace touchmark::bench::experiments::suite
