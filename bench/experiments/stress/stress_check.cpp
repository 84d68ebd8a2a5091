#include "bench/experiments/stress/stress_check.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "bench/experiments/stress/stress_csv.h"
#include "bench/results/validation/row_check.h"

namespace touchmark::bench::experiments::stress {

namespace validation = results::validation;

namespace {

/// Columns that count probes, each at most once.
constexpr std::array of_probes{"missed",           "false_contacts", "wrong_triangle", "beyond_bound",
                               "wrong_point",      "wrong_normal",   "malformed",      "unresolved",
                               "beyond_tolerance", "rounding",       "wrong_side"};
constexpr std::array errors{"max_distance_error", "max_distance_error_of_diagonal", "max_distance_error_ulp"};

void check_numbers(const validation::RowCheck& row) {
  const std::uint64_t probes = row.count("probes");
  for (const char* column : of_probes)
    row.expect(row.count(column) <= probes, column, fmt::format("is above probes {}", probes));
  for (const char* column : errors)
    row.expect(!row.field(column).empty() || probes == 0, column, "must not be empty where there are probes");
}

void check_status(const validation::RowCheck& row) {
  const std::string status = row.field("status");
  const bool wrong = row.count("missed") + row.count("false_contacts") + row.count("malformed") > 0;
  const bool inexact = row.count("wrong_triangle") + row.count("beyond_bound") + row.count("wrong_point") +
                           row.count("wrong_normal") >
                       0;
  const auto expect = [&](bool right) { row.expect(right, "status", "is not so by its own counts"); };
  if (status == "ok") expect(!wrong && !inexact && row.count("probes") > 0);
  if (status == "inexact") expect(!wrong && inexact);
  if (status == "wrong") expect(wrong);
  if (status == "crashed") expect(row.count("crashes") > 0);
  if (status == "timeout") expect(row.count("timeouts") > 0);
  if (status == "refused") expect(row.count("refusals") > 0);
}

}  // namespace

void check_stress(const validation::CsvTable& table, const nlohmann::json* run, validation::Faults& faults) {
  const std::size_t required = stress_columns().size() - appended_stress_columns;
  validation::check_rows(table, stress_columns(), required, faults, [&](const validation::RowCheck& row) {
    row.check_fields(stress_columns(), false);
    row.expect_run_id(run);
    check_numbers(row);
    check_status(row);
  });
}

}  // namespace touchmark::bench::experiments::stress
