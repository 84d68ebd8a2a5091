/// stress.csv, schema 1: one row a contestant, family and query. Columns are only ever appended.
#pragma once

#include <string>
#include <vector>

#include "bench/experiments/stress/score.h"

namespace touchmark::bench::experiments::stress {

inline constexpr int stress_schema = 1;

std::string stress_csv(const std::string& run_id, const std::vector<Score>& scores);

std::vector<std::string> stress_columns();

}  // namespace touchmark::bench::experiments::stress
