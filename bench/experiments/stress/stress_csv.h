/// stress.csv, schema 1: one row a contestant, family and query. Columns are only ever appended.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/experiments/stress/score.h"
#include "bench/results/column.h"
#include "bench/results/validation/fault.h"
#include "bench/results/validation/results_check.h"

namespace touchmark::bench::experiments::stress {

inline constexpr int stress_schema = 1;

/// All columns in their order; the last three were appended.
std::span<const results::Column<Score>> stress_columns();
inline constexpr std::size_t appended_stress_columns = 3;

std::string stress_csv(const std::string& run_id, const std::vector<Score>& scores);

/// Checks that a file is a stress.csv of schema 1, and agrees with itself and with its run.json. `run` is the
/// run.json beside the file, if there is one.
void check_stress(const results::validation::CsvTable& table, const nlohmann::json* run,
                  results::validation::Faults& faults);

}  // namespace touchmark::bench::experiments::stress
