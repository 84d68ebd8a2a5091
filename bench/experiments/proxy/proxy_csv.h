/// proxy.csv, schema 1: one row a method and family. Columns are only ever appended.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/experiments/proxy/proxy_run.h"
#include "bench/results/column.h"

namespace touchmark::bench::experiments::proxy {

inline constexpr int proxy_schema = 1;

std::span<const results::Column<Score>> proxy_columns();

std::string proxy_csv(const std::string& run_id, const std::vector<Score>& scores);

}  // namespace touchmark::bench::experiments::proxy
