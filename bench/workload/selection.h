/// What is asked along the trajectories of one mesh, as the command line chose and checked it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bench/support/length.h"
#include "bench/support/length_unit.h"
#include "bench/trajectories/motion_options.h"
#include "bench/workload/answer.h"

namespace touchmark::bench::workload {

struct Selection {
  std::vector<Query> queries;  ///< one, or all three
  support::Length radius;
  std::optional<support::Length> reach;  ///< nothing: each probe's radius
  std::optional<std::size_t> steps;
  trajectories::MotionOptions motion;
  std::optional<support::LengthUnit> unit;  ///< the mesh's; nothing: unknown
  std::uint64_t seed = 1;
};

}  // namespace touchmark::bench::workload
