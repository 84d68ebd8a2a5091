/// The parts of a run.json that do not depend on what was run.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/results/run_json.h"

namespace touchmark::bench::results {

/// What every run.json begins with: machine, build, seed and command line.
nlohmann::ordered_json run_circumstances(const RunDescription& run);

/// An entry of "contestants".
nlohmann::ordered_json contestant_json(const contestants::ContestantSpec& spec, bool flushed_to_zero);

}  // namespace touchmark::bench::results
