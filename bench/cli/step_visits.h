/// What one of our detectors looked at in steps of a trajectory: a row of visited.json.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/workload/workload.h"

namespace touchmark::bench::cli {

/// Becomes the program touchmark-tracer, which asks the first trajectory's steps and writes what the detector
/// looked at in these to standard output, as JSON. Throws std::invalid_argument for a step that there is not,
/// a scene of bodies, and where that program is not beside this one; ResourceError where it cannot be run.
[[noreturn]] void print_visits(const workload::Workload& workload, workload::Query query,
                               const std::string& detector, std::vector<std::uint64_t> steps);

}  // namespace touchmark::bench::cli
