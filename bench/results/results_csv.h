/// results.csv, schema 1: one row a contestant, scene, trajectory and query. Columns are only ever appended.
#pragma once

#include <string>
#include <vector>

#include "bench/measurement/result_row.h"

namespace touchmark::bench::results {

inline constexpr int results_schema = 1;

/// Header and rows, each ended by a line feed; fields quoted as RFC 4180 has it; empty where nothing was
/// measured.
std::string results_csv(const std::string& run_id, const std::vector<measurement::ResultRow>& rows);

/// The names of all columns, in their order.
std::vector<std::string> results_columns();

/// The fields of one row, in the order of the columns.
std::vector<std::string> results_fields(const std::string& run_id, const measurement::ResultRow& row);

/// One line, ended by a line feed.
std::string csv_line(const std::vector<std::string>& fields);

/// One field, in quotes if it needs them.
std::string csv_field(const std::string& text);

}  // namespace touchmark::bench::results
