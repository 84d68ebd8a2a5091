/// What `touchmark stress` says: a table for people and run.json for programs.
#pragma once

#include <string>
#include <vector>

#include "bench/experiments/stress/score.h"
#include "bench/experiments/stress/stress_run.h"
#include "bench/results/junit.h"
#include "bench/results/run_json.h"
#include "bench/support/table.h"

namespace touchmark::bench::experiments::stress {

/// Contestants by families.
support::Table stress_table(const std::vector<Score>& scores);

/// What the columns of the table stand for, and the sums.
std::string stress_legend(const std::vector<Score>& scores);

/// Returns a case a contestant, family and query, which fails where a claim of exactness is broken.
std::vector<results::TestCase> cases_of(const std::vector<Score>& scores);

std::string stress_json(const results::RunDescription& description, const StressRun& run);

}  // namespace touchmark::bench::experiments::stress
