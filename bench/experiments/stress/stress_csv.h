/// stress.csv, schema 1: one row a contestant, family and query. Columns are only ever appended.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/experiments/stress/score.h"
#include "bench/results/column.h"

namespace touchmark::bench::experiments::stress {

inline constexpr int stress_schema = 1;

/// All columns in their order; the last three were appended.
std::span<const results::Column<Score>> stress_columns();
inline constexpr std::size_t appended_stress_columns = 3;

std::string stress_csv(const std::string& run_id, const std::vector<Score>& scores);

}  // namespace touchmark::bench::experiments::stress
