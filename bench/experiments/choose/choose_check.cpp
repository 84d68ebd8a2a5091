#include "bench/experiments/choose/choose_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

#include <fmt/format.h>

#include "bench/experiments/choose/choose_csv.h"
#include "bench/results/validation/row_check.h"

namespace touchmark::bench::experiments::choose {

namespace validation = results::validation;

namespace {

constexpr double digits = 1e-5;  // numbers are written with six

/// Whoever has a rank holds, whoever has none says why not.
void check_rank(const validation::RowCheck& row, std::set<std::uint64_t>& ranks) {
  const bool ranked = !row.field("rank").empty();
  row.expect(ranked == row.field("why_not").empty(), "why_not", "must be there just where there is no rank");
  if (!ranked) return;
  row.expect(ranks.insert(row.count("rank")).second, "rank", "is another row's as well");
  row.expect(row.is_ok(), "status", "must be ok where there is a rank");
  row.expect(row.count("wrong_answers") == 0, "wrong_answers", "must be 0 where there is a rank");
  row.expect(row.field("guarantee") == "exact", "guarantee", "must be exact where there is a rank");
  row.expect(row.number("margin_usual").value_or(0) >= 1, "margin_usual",
             "must be 1 or more where there is a rank");
  if (!row.field("max_bytes").empty())
    row.expect(!row.field("bytes").empty() && row.count("bytes") <= row.count("max_bytes"), "bytes",
               fmt::format("must be at most max_bytes {} where there is a rank", row.field("max_bytes")));
}

void check_margins(const validation::RowCheck& row) {
  const auto number = [&](const char* column) { return row.number(column).value_or(0); };
  const double budget_ns = number("share") * 1e9 / number("rate_hz");
  const auto expect = [&](const char* margin, double time) {
    if (row.field(margin).empty()) return;
    row.expect(std::abs(number(margin) * time / budget_ns - 1) <= digits, margin,
               "does not follow from the times, the share and the rate");
  };
  expect("margin_usual", std::max(number("warm_ns_p999"), number("cold_ns_p99")));
  expect("margin_worst", std::max(number("warm_ns_max"), number("cold_ns_max")));
  row.expect(number("warm_ns_p999") <= number("warm_ns_max"), "warm_ns_p999", "is above warm_ns_max");
  row.expect(number("cold_ns_p99") <= number("cold_ns_max"), "cold_ns_p99", "is above cold_ns_max");
}

}  // namespace

void check_choose(const validation::CsvTable& table, const nlohmann::json* run, validation::Faults& faults) {
  const auto columns = choose_columns();
  std::set<std::uint64_t> ranks;
  validation::check_rows(table, columns, columns.size(), faults, [&](const validation::RowCheck& row) {
    row.check_fields(columns, false);
    row.expect_run_id(run);
    check_rank(row, ranks);
    check_margins(row);
  });
  if (!ranks.empty() && *ranks.rbegin() != ranks.size())
    faults.push_back(
        {table.path, 0, "rank", std::to_string(*ranks.rbegin()), "is above the number of ranks"});
}

}  // namespace touchmark::bench::experiments::choose
