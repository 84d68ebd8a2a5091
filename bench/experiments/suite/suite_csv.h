/// suite.csv, schema 1. Columns are only ever appended.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/experiments/suite/suite_score.h"
#include "bench/results/column.h"
#include "bench/results/validation/fault.h"
#include "bench/results/validation/results_check.h"

namespace touchmark::bench::experiments::suite {

inline constexpr int suite_schema = 1;

/// A row with what all rows have.
struct SuiteLine {
  std::uint64_t seed = 0;  ///< the plan and the trajectories follow from it
  const SuiteRow& row;
};

std::span<const results::Column<SuiteLine>> suite_columns();

/// One row for each of ours, and the best of them, in each cell.
std::string suite_csv(const std::string& run_id, std::uint64_t seed, const std::vector<SuiteRow>& rows);

/// Checks that a file is a suite.csv of schema 1, and agrees with itself and its run.json. `run` is the
/// run.json beside the file, or null.
void check_suite(const results::validation::CsvTable& table, const nlohmann::json* run,
                 results::validation::Faults& faults);

}  // namespace touchmark::bench::experiments::suite
