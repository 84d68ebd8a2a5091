/// Checks that a file is a suite.csv of schema 1, and agrees with itself and its run.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bench/results/validation/fault.h"
#include "bench/results/validation/results_check.h"

namespace touchmark::bench::experiments::suite {

/// `run` is the run.json beside the file, or null.
void check_suite(const results::validation::CsvTable& table, const nlohmann::json* run,
                 results::validation::Faults& faults);

}  // namespace touchmark::bench::experiments::suite
