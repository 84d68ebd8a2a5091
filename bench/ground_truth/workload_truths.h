/// The ground truth about a workload, whether that is a mesh or a scene of bodies.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "bench/ground_truth/ground_truth.h"
#include "bench/oracle/oracle.h"
#include "bench/oracle/scene_oracle.h"
#include "bench/scenes/schedule.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::ground_truth {

/// The oracle of a workload's mesh, or of its bodies.
class WorkloadTruths {
 public:
  /// The workload must outlive it.
  explicit WorkloadTruths(const workload::Workload& workload);
  WorkloadTruths(const WorkloadTruths&) = delete;
  WorkloadTruths& operator=(const WorkloadTruths&) = delete;

  /// Returns the truths of a trace, which this must outlive. Of a scene one trace at a time: they move its
  /// bodies.
  std::unique_ptr<TraceTruths> of(std::size_t trace);

 private:
  const workload::Workload& workload_;
  std::optional<oracle::Oracle> oracle_;             ///< empty for a scene
  scenes::PlacedScene scene_;                        ///< empty for a mesh
  std::optional<oracle::SceneOracle> scene_oracle_;  ///< which its truths move
};

}  // namespace touchmark::bench::ground_truth
