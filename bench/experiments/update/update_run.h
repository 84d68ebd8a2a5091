/// One mesh, deformed in several ways, and what every contestant makes of it: how long updates and builds
/// take, and whether the answers afterwards are right.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/contestants/roster.h"
#include "bench/experiments/update/update_row.h"
#include "bench/ground_truth/ground_truth.h"
#include "bench/meshes/deformation.h"
#include "bench/oracle/oracle.h"
#include "bench/workers/contestant_process.h"
#include "bench/workload/workload.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::update {

class UpdateRun {
 public:
  /// Throws std::invalid_argument or MeshError.
  UpdateRun(const contestants::Roster& roster, const std::vector<contestants::ContestantSpec>& contestants,
            const workload::Selection& selection, std::string mesh_name, const TriangleMesh& mesh,
            const std::vector<double>& shares, const std::string& trajectory,
            const workers::WorkerOptions& workers);

  /// A row for each share. Whatever the worker does is the status of the rest of them; only ResourceError and
  /// Interrupted are thrown.
  std::vector<UpdateRow> run(std::size_t contestant, const std::function<void(double share)>& progress);

  const workload::Workload& workload() const noexcept { return workload_; }
  const std::deque<workers::ContestantProcess>& contestants() const noexcept { return processes_; }

 private:
  /// A deformed mesh with what is asked of it: first the trajectory, then probes about what moved.
  struct DeformedMesh {
    DeformedMesh(const TriangleMesh& mesh, const meshes::Deformation& how);

    meshes::Deformation deformation;
    TriangleMesh mesh;
    std::size_t moved;
    oracle::Oracle oracle;
    std::vector<ground_truth::GroundTruths> truths;  // one a trace
  };
  static constexpr std::size_t traces_a_mesh = 2;

  void measure(workers::ContestantProcess& process, std::size_t index, UpdateRow& row);
  workers::Task task_for(std::size_t trace) const;
  workers::Timed timed(workers::ContestantProcess& process, const workers::Task& task) const;

  workload::Query query_;
  std::vector<std::unique_ptr<DeformedMesh>> meshes_;
  workload::Workload workload_;
  workers::SharedArena arena_;
  std::deque<workers::ContestantProcess> processes_;
};

}  // namespace touchmark::bench::experiments::update
