#include "bench/experiments/choose/choose_csv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

#include <fmt/format.h>

#include "bench/results/validation/row_check.h"
#include "bench/support/table.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::choose {
namespace {

using Line = const ChooseLine&;
namespace kinds = results::kinds;
using enum results::Presence;

using C = Candidate;
using T = QueryTimes;
using W = workload::Workload;
using results::rounded, results::text;

const Candidate& row(Line line) { return line.candidate; }
const W& load(Line line) { return line.asked.workload; }
const Limits& limits(Line line) { return line.asked.limits; }
constexpr auto of_times = &C::times;

template <double (*margin)(const QueryTimes&, const Limits&) noexcept>
std::string of_margin(Line line) {
  const std::optional<T>& times = line.candidate.times;
  return times ? rounded<6>(margin(*times, limits(line))) : "";
}

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<ChooseLine>>({
    {"schema", [](Line) { return std::to_string(choose_schema); }, always, kinds::one},
    {"run_id", nullptr, always},
    {"detector", text<row, &C::detector>, always},
    {"options", text<row, &C::options>, optional},
    {"mesh", text<load, &W::mesh_name>, always},
    {"triangles", text<load, &W::mesh, &TriangleMesh::size>, always, kinds::whole_number},
    {"query", [](Line line) { return text(line.asked.query); }, always, kinds::query},
    {"radius", text<load, &W::radius>, always, kinds::length},
    {"reach", [](Line line) { return text(load(line).reach.value_or(load(line).radius)); }, always,
     kinds::length},
    {"rate_hz", text<limits, &Limits::rate_hz>, always, kinds::positive},
    {"share", text<limits, &Limits::share>, always, kinds::share},
    {"max_bytes",
     [](Line line) { return limits(line).max_bytes ? fmt::format("{:.0f}", *limits(line).max_bytes) : ""; },
     optional, kinds::whole_number},
    {"motions", [](Line line) { return text(load(line).trajectories.size()); }, always,
     kinds::positive_count},
    {"guarantee", [](Line line) { return std::string(line.candidate.claims_exactness ? "exact" : ""); },
     optional, kinds::guarantee},
    {"judged", text<row, &C::judged>, always, kinds::whole_number},
    {"wrong_answers", text<row, &C::wrong>, always, kinds::whole_number},
    {"status", text<row, &C::status>, always},
    {"rank", [](Line line) { return line.rank > 0 ? text<&ChooseLine::rank>(line) : ""; }, optional,
     kinds::positive_count},
    {"why_not", [](Line line) { return why_not(line.candidate, line.asked.limits); }, optional},
    {"margin_usual", of_margin<margin_usual>, optional, kinds::positive},
    {"margin_worst", of_margin<margin_worst>, optional, kinds::positive},
    {"warm_ns_p999", rounded<6, row, of_times, &T::warm_p999>, optional, kinds::positive},
    {"warm_ns_max", rounded<6, row, of_times, &T::warm_max>, optional, kinds::positive},
    {"cold_ns_p50", rounded<6, row, of_times, &T::cold_p50>, optional, kinds::positive},
    {"cold_ns_p99", rounded<6, row, of_times, &T::cold_p99>, optional, kinds::positive},
    {"cold_ns_max", rounded<6, row, of_times, &T::cold_max>, optional, kinds::positive},
    {"cold_samples", text<row, of_times, &T::cold_samples>, optional, kinds::positive_count},
    {"slowest_motion", text<row, of_times, &T::motion>, optional},
    {"build_ms", rounded<6, row, &C::build_ms>, optional, kinds::finite},
    {"bytes", text<row, &C::bytes>, optional, kinds::whole_number},
});

namespace validation = results::validation;

constexpr double digits = 1e-5;  // numbers are written with six

/// A candidate with a rank holds; one without says why it does not.
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

std::span<const results::Column<ChooseLine>> choose_columns() { return columns; }

std::string choose_csv(const std::string& run_id, const Asked& asked,
                       const std::vector<Candidate>& candidates) {
  std::vector<std::size_t> ranks(candidates.size());
  std::size_t rank = 0;
  for (const std::size_t i : ranking(candidates, asked.limits)) ranks[i] = ++rank;
  support::Table table(results::names_of(columns));
  for (std::size_t i = 0; i < candidates.size(); ++i)
    table.add(results::fields_of(columns, ChooseLine{asked, candidates[i], ranks[i]}, run_id));
  return table.csv();
}

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
