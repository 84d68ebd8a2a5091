/// What `touchmark stress` says: a table for people and run.json for programs.
#pragma once

#include <string>
#include <vector>

#include "bench/experiments/stress/score.h"
#include "bench/experiments/stress/stress_run.h"
#include "bench/results/run_json.h"

namespace touchmark::bench::experiments::stress {

/// Contestants by families, what the columns stand for, and the sums.
std::string stress_table(const std::vector<Score>& scores);

std::string stress_json(const results::RunDescription& description, const StressRun& run);

}  // namespace touchmark::bench::experiments::stress
