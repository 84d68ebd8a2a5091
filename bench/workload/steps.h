/// What is asked along a trajectory, step by step.
#pragma once

#include <cstddef>
#include <span>

#include "bench/scenes/schedule.h"
#include "bench/workload/answer.h"
#include "core/probe.h"

namespace touchmark::bench::workload {

/// One servo tick's question. A sweep goes from the previous step's centre to this one's; the first step's
/// stands still.
struct Step {
  Probe probe;
  double reach = 0;  ///< for `nearest`
};

/// The steps [begin, end) of a trace.
struct StepRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t size() const noexcept { return end - begin; }
};

/// A whole trajectory with what is asked along it.
struct QueryTrace {
  Query query = Query::nearest;
  std::span<const Step> steps;
  const scenes::ScheduleView* schedule = nullptr;  ///< a scene's; null: a mesh
};

}  // namespace touchmark::bench::workload
