/// results.csv, schema 1: one row a contestant, scene, trajectory and query. Columns are only ever appended.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/measurement/result_row.h"
#include "bench/results/column.h"

namespace touchmark::bench::results {

inline constexpr int results_schema = 1;

/// A file may end before a column that was appended later, but not before these; and it may have further
/// columns that are not known here.
inline constexpr std::size_t columns_of_the_contract = 36;

/// All columns in their order: the one place where a column is said to exist.
std::span<const Column<measurement::ResultRow>> results_columns();

/// Header and rows; a field is empty where nothing was measured.
std::string results_csv(const std::string& run_id, const std::vector<measurement::ResultRow>& rows);

}  // namespace touchmark::bench::results
