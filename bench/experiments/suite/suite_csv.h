/// suite.csv, schema 1. Columns are only ever appended.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/experiments/suite/suite_score.h"
#include "bench/results/column.h"

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

}  // namespace touchmark::bench::experiments::suite
