#include "bench/experiments/many/many_check.h"

#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "bench/experiments/many/many_row.h"
#include "bench/results/validation/row_check.h"

namespace touchmark::bench::experiments::many {

namespace validation = results::validation;

namespace {

/// Numbers are written with four digits.
bool nearly(double a, double b) { return std::abs(a - b) <= 2e-3 * std::abs(b); }

void check_numbers(const validation::RowCheck& row) {
  const double ns = row.number("ns_per_point").value_or(0);
  const std::uint64_t points = row.count("points"), all = points * row.count("calls");
  row.expect(nearly(row.number("points_per_second").value_or(0), 1e9 / ns), "points_per_second",
             "is not 1e9 / ns_per_point");
  row.expect(nearly(row.number("us_per_call").value_or(0), 1e-3 * ns * static_cast<double>(points)),
             "us_per_call", "is not ns_per_point times points");
  row.expect(row.count("answered") <= all, "answered",
             fmt::format("is above the {} points of all calls", all));
  row.expect((row.field("status") == "wrong") == (row.count("differing") > 0), "status",
             "does not go with differing");
}

}  // namespace

void check_many(const validation::CsvTable& table, validation::Faults& faults) {
  validation::check_rows(table, many_columns(), many_columns().size(), faults,
                         [](const validation::RowCheck& row) {
                           row.check_fields(many_columns(), false);
                           check_numbers(row);
                         });
}

}  // namespace touchmark::bench::experiments::many
