#include "bench/experiments/stress/stress_csv.h"

#include <array>

#include <fmt/format.h>

#include "bench/results/results_csv.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::stress {
namespace {

struct Column {
  std::string_view name;
  std::string (*value)(const Score& score);
};

std::string number(double value) { return fmt::format("{}", value); }
std::string count(std::uint64_t value) { return fmt::format("{}", value); }

template <auto Member>
std::string counted(const Score& score) {
  return count(score.counts.*Member);
}
template <auto Member>
std::string error(const Score& score) {
  return score.counts.judged > 0 ? number(score.counts.*Member) : "";
}

using S = const Score&;

// The order is the contract. schema and run_id come before these.
constexpr std::array columns{
    Column{"detector", [](S score) { return score.detector; }},
    Column{"options", [](S score) { return score.options; }},
    Column{"family", [](S score) { return std::string(score.family->name); }},
    Column{"query", [](S score) { return std::string(name_of(score.query)); }},
    Column{"guarantee", [](S score) { return std::string(score.guarantee); }},
    Column{"adversarial", [](S score) { return count(score.family->adversarial ? 1 : 0); }},
    Column{"meshes", [](S score) { return count(score.meshes); }},
    Column{"probes", counted<&oracle::ErrorCounts::judged>},
    Column{"missed", counted<&oracle::ErrorCounts::missed>},
    Column{"false_contacts", counted<&oracle::ErrorCounts::false_contacts>},
    Column{"wrong_triangle", counted<&oracle::ErrorCounts::wrong_triangle>},
    Column{"beyond_bound", counted<&oracle::ErrorCounts::beyond_bound>},
    Column{"wrong_point", counted<&oracle::ErrorCounts::wrong_point>},
    Column{"wrong_normal", counted<&oracle::ErrorCounts::wrong_normal>},
    Column{"malformed", counted<&oracle::ErrorCounts::malformed>},
    Column{"unresolved", counted<&oracle::ErrorCounts::unresolved>},
    Column{"max_distance_error", error<&oracle::ErrorCounts::max_distance_error>},
    Column{"max_distance_error_of_diagonal", error<&oracle::ErrorCounts::max_distance_error_of_diagonal>},
    Column{"max_distance_error_ulp", error<&oracle::ErrorCounts::max_distance_error_ulp>},
    Column{"status", [](S score) { return std::string(name_of(score.standing())); }},
    Column{"crashes", [](S score) { return count(score.crashes); }},
    Column{"timeouts", [](S score) { return count(score.timeouts); }},
    Column{"refusals", [](S score) { return count(score.refusals); }},
    Column{"ns_per_query",
           [](S score) {
             const std::optional<double> ns = score.ns_per_query();
             return ns ? fmt::format("{:.6g}", *ns) : std::string();
           }},
    // Appended to schema 1.
    Column{"beyond_tolerance", counted<&oracle::ErrorCounts::beyond_tolerance>},
    Column{"rounding", counted<&oracle::ErrorCounts::rounding>},
    Column{"wrong_side", counted<&oracle::ErrorCounts::wrong_side>},
};

}  // namespace

std::vector<std::string> stress_columns() {
  std::vector<std::string> names{"schema", "run_id"};
  for (const Column& column : columns) names.emplace_back(column.name);
  return names;
}

std::string stress_csv(const std::string& run_id, const std::vector<Score>& scores) {
  std::string csv = results::csv_line(stress_columns());
  for (const Score& score : scores) {
    std::vector<std::string> fields{std::to_string(stress_schema), run_id};
    for (const Column& column : columns) fields.push_back(column.value(score));
    csv += results::csv_line(fields);
  }
  return csv;
}

}  // namespace touchmark::bench::experiments::stress
