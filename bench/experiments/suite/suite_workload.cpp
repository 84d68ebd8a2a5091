#include "bench/experiments/suite/suite_workload.h"

#include <algorithm>
#include <utility>

#include "bench/results/system_info.h"
#include "bench/support/length.h"

namespace touchmark::bench::experiments::suite {

MeshWorkload workload_of(const SuiteMesh& planned, const TriangleMesh& mesh, std::size_t steps,
                         std::uint64_t seed) {
  MeshWorkload all{{results::without_directories(planned.mesh), mesh, 0, {}, {}, {}}, {}};
  std::vector<const SuiteCell*> made;
  for (const SuiteCell& cell : planned.cells) {
    const auto known = std::ranges::find_if(made, [&](const SuiteCell* other) {
      return other->trajectory == cell.trajectory && other->reach == cell.reach;
    });
    all.trace_of.push_back(static_cast<std::size_t>(known - made.begin()));
    if (known != made.end()) continue;
    made.push_back(&cell);
    workload::Selection selection;
    selection.radius = *support::parse_length(cell.radius());
    selection.reach = support::parse_length(cell.reach);
    selection.steps = steps;
    selection.seed = seed;
    workload::Workload one =
        workload::make_workload(all.workload.mesh_name, mesh, selection, {cell.trajectory}, steps);
    all.workload.radius = std::max(all.workload.radius, one.radius);
    all.workload.trajectories.push_back(std::move(one.trajectories.front()));
    all.workload.traces.push_back(std::move(one.traces.front()));
    all.workload.motions.push_back(one.motions.front());
  }
  return all;
}

}  // namespace touchmark::bench::experiments::suite
