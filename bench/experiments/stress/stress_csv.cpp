#include "bench/experiments/stress/stress_csv.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "bench/results/validation/row_check.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::stress {
namespace {

template <auto Member>
std::string error(const Score& score) {
  return score.counts.judged > 0 ? fmt::format("{}", score.counts.*Member) : "";
}

constexpr results::Kind standing{[](std::string_view text) {
                                   constexpr std::array standings{"ok",      "unsupported", "refused",
                                                                  "inexact", "wrong",       "timeout",
                                                                  "crashed"};
                                   return std::ranges::find(standings, text) != standings.end();
                                 },
                                 "one of ok, unsupported, refused, inexact, wrong, timeout, crashed"};

using E = oracle::ErrorCounts;
using S = const Score&;

using enum results::Presence;
using namespace results::kinds;
using results::text, results::rounded;

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<Score>>({
    {"schema", [](S) { return std::to_string(stress_schema); }, always, one},
    {"run_id", nullptr, always},
    {"detector", text<&Score::detector>, always},
    {"options", text<&Score::options>},
    {"family", [](S score) { return std::string(score.family->name); }, always},
    {"query", text<&Score::query>, always, query},
    {"guarantee", text<&Score::guarantee>, optional, guarantee},
    {"adversarial", [](S score) { return fmt::format("{:d}", score.family->adversarial); }, always, bit},
    {"meshes", text<&Score::meshes>, always, whole_number},
    {"probes", text<&Score::counts, &E::judged>, always, whole_number},
    {"missed", text<&Score::counts, &E::missed>, always, whole_number},
    {"false_contacts", text<&Score::counts, &E::false_contacts>, always, whole_number},
    {"wrong_triangle", text<&Score::counts, &E::wrong_triangle>, always, whole_number},
    {"beyond_bound", text<&Score::counts, &E::beyond_bound>, always, whole_number},
    {"wrong_point", text<&Score::counts, &E::wrong_point>, always, whole_number},
    {"wrong_normal", text<&Score::counts, &E::wrong_normal>, always, whole_number},
    {"malformed", text<&Score::counts, &E::malformed>, always, whole_number},
    {"unresolved", text<&Score::counts, &E::unresolved>, always, whole_number},
    {"max_distance_error", error<&E::max_distance_error>, optional, length},
    {"max_distance_error_of_diagonal", error<&E::max_distance_error_of_diagonal>, optional, length},
    {"max_distance_error_ulp", error<&E::max_distance_error_ulp>, optional, length},
    {"status", text<&Score::standing>, always, standing},
    {"crashes", text<&Score::crashes>, always, whole_number},
    {"timeouts", text<&Score::timeouts>, always, whole_number},
    {"refusals", text<&Score::refusals>, always, whole_number},
    {"ns_per_query", rounded<6, &Score::ns_per_query>, optional, positive},
    // Appended to schema 1.
    {"beyond_tolerance", text<&Score::counts, &E::beyond_tolerance>, always, whole_number},
    {"rounding", text<&Score::counts, &E::rounding>, always, whole_number},
    {"wrong_side", text<&Score::counts, &E::wrong_side>, always, whole_number},
});

namespace validation = results::validation;

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

std::span<const results::Column<Score>> stress_columns() { return columns; }

std::string stress_csv(const std::string& run_id, const std::vector<Score>& scores) {
  return results::table_of(columns, scores, run_id).csv();
}

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
