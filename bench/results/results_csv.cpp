#include "bench/results/results_csv.h"

#include <array>
#include <string_view>

#include <fmt/format.h>

#include "bench/support/numbers.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::results {
namespace {

struct Column {
  std::string_view name;
  std::string (*value)(const measurement::ResultRow& row);
};

std::string exactly(double value) { return fmt::format("{}", value); }
/// Times: more digits than the clock has would be noise.
std::string rounded(double value) { return fmt::format("{:.6g}", value); }

template <auto Member>
std::string count_of(const measurement::ResultRow& row) {
  return row.counts ? fmt::format("{}", (*row.counts).*Member) : "";
}

template <auto Member>
std::string stored_count_of(const measurement::ResultRow& row) {
  return row.rounded_scene_counts ? fmt::format("{}", (*row.rounded_scene_counts).*Member) : "";
}

template <auto Member>
std::string error_of(const measurement::ResultRow& row) {
  return row.counts ? exactly((*row.counts).*Member) : "";
}

template <auto Member>
std::string throughput_of(const measurement::ResultRow& row) {
  return row.throughput ? rounded((*row.throughput).*Member) : "";
}

template <auto Member>
std::string latency_of(const measurement::ResultRow& row) {
  return row.latency ? rounded((*row.latency).*Member) : "";
}

template <auto Member>
std::string prepare_of(const measurement::ResultRow& row) {
  return row.prepare ? rounded((*row.prepare).*Member) : "";
}

template <auto Latency>
std::string p999_in(const measurement::ResultRow& row) {
  const std::optional<double> ns = measurement::p999_of(row, row.*Latency);
  return ns ? rounded(*ns) : "";
}

template <auto Member>
std::string undisturbed_of(const measurement::ResultRow& row) {
  return row.throughput ? rounded(row.throughput->undisturbed.*Member) : "";
}

template <std::size_t Deadline>
std::string misses_of(const measurement::ResultRow& row) {
  return row.latency ? fmt::format("{}", row.latency->deadlines[Deadline].misses) : "";
}

template <std::size_t Deadline>
std::string longest_run_of(const measurement::ResultRow& row) {
  return row.latency ? fmt::format("{}", row.latency->deadlines[Deadline].longest_run) : "";
}

template <auto Member>
std::string optional_time(const measurement::ResultRow& row) {
  return row.*Member ? rounded(*(row.*Member)) : "";
}

template <auto Member>
std::string optional_count(const measurement::ResultRow& row) {
  return row.*Member ? fmt::format("{}", *(row.*Member)) : "";
}

template <auto Member>
std::string work_of(const measurement::ResultRow& row) {
  if (!row.work) return "";
  return rounded(static_cast<double>(row.work->total.*Member) / static_cast<double>(row.steps));
}

using R = measurement::ResultRow;
using Row = const measurement::ResultRow&;

// The order is the contract. schema and run_id come before these.
constexpr std::array columns{
    Column{"detector", [](Row row) { return row.detector; }},
    Column{"options", [](Row row) { return row.options; }},
    Column{"mesh", [](Row row) { return row.mesh; }},
    Column{"triangles", [](Row row) { return fmt::format("{}", row.triangles); }},
    Column{"trajectory", [](Row row) { return row.trajectory; }},
    Column{"query", [](Row row) { return std::string(workload::name_of(row.query)); }},
    Column{"steps", [](Row row) { return fmt::format("{}", row.steps); }},
    Column{"radius", [](Row row) { return exactly(row.radius); }},
    Column{"reach", [](Row row) { return exactly(row.reach); }},
    Column{"guarantee", [](Row row) { return std::string(measurement::guarantee_name(row)); }},
    Column{"missed", count_of<&oracle::ErrorCounts::missed>},
    Column{"false_contacts", count_of<&oracle::ErrorCounts::false_contacts>},
    Column{"wrong_triangle", count_of<&oracle::ErrorCounts::wrong_triangle>},
    Column{"max_distance_error", error_of<&oracle::ErrorCounts::max_distance_error>},
    Column{"max_distance_error_ulp", error_of<&oracle::ErrorCounts::max_distance_error_ulp>},
    Column{"max_normal_angle_deg", error_of<&oracle::ErrorCounts::max_normal_angle_deg>},
    Column{"unresolved", count_of<&oracle::ErrorCounts::unresolved>},
    Column{"status", [](Row row) { return row.status; }},
    Column{"ns_per_query", throughput_of<&measurement::ThroughputResult::ns_per_query>},
    Column{"ns_p50", latency_of<&measurement::LatencySummary::p50>},
    Column{"ns_p90", latency_of<&measurement::LatencySummary::p90>},
    Column{"ns_p99", latency_of<&measurement::LatencySummary::p99>},
    Column{"ns_p999", p999_in<&R::latency>},
    Column{"ns_max", latency_of<&measurement::LatencySummary::max>},
    Column{"update_rate_hz",
           [](Row row) { return row.throughput ? rounded(1e9 / row.throughput->ns_per_query) : ""; }},
    Column{"deadline_misses_1khz", misses_of<0>},
    Column{"longest_miss_run_1khz", longest_run_of<0>},
    Column{"build_ms", optional_time<&R::build_ms>},
    Column{"first_answer_ms", optional_time<&R::first_answer_ms>},
    Column{"bytes", optional_count<&R::bytes>},
    Column{"heap_bytes", optional_count<&R::heap_bytes>},
    Column{"work_mean", [](Row row) { return row.work ? rounded(row.work->mean) : ""; }},
    Column{"work_max", [](Row row) { return row.work ? fmt::format("{}", row.work->max) : ""; }},
    Column{"repetitions",
           [](Row row) { return row.throughput ? fmt::format("{}", row.throughput->repetitions) : ""; }},
    // Appended to schema 1.
    Column{"ns_per_query_min", throughput_of<&measurement::ThroughputResult::ns_per_query_min>},
    Column{"ns_per_query_mad", throughput_of<&measurement::ThroughputResult::ns_per_query_mad>},
    Column{"ns_per_query_first_pass", throughput_of<&measurement::ThroughputResult::ns_per_query_first_pass>},
    Column{"deadline_misses_4khz", misses_of<1>},
    Column{"longest_miss_run_4khz", longest_run_of<1>},
    Column{"deadline_misses_10khz", misses_of<2>},
    Column{"longest_miss_run_10khz", longest_run_of<2>},
    Column{"clock_cost_ns", [](Row row) { return row.latency ? rounded(row.clock_cost_ns) : ""; }},
    Column{"max_distance_error_of_diagonal", error_of<&oracle::ErrorCounts::max_distance_error_of_diagonal>},
    Column{"beyond_bound", count_of<&oracle::ErrorCounts::beyond_bound>},
    Column{"wrong_point", count_of<&oracle::ErrorCounts::wrong_point>},
    Column{"wrong_normal", count_of<&oracle::ErrorCounts::wrong_normal>},
    Column{"malformed", count_of<&oracle::ErrorCounts::malformed>},
    Column{"cpu_ns_per_query", throughput_of<&measurement::ThroughputResult::cpu_ns_per_query>},
    Column{"answers_checksum", [](Row row) { return row.checksum ? support::hex(*row.checksum) : ""; }},
    Column{"cells_mean", work_of<&Work::cells>},
    Column{"spheres_mean", work_of<&Work::spheres>},
    Column{"boxes_mean", work_of<&Work::boxes>},
    Column{"triangles_mean", work_of<&Work::triangles>},
    Column{"exact_decisions",
           [](Row row) { return row.work ? fmt::format("{}", row.work->total.exact_decisions) : ""; }},
    Column{"decides_exactly",
           [](Row row) { return row.accuracy ? fmt::format("{:d}", row.accuracy->decides_exactly) : ""; }},
    Column{"stored_missed", stored_count_of<&oracle::ErrorCounts::missed>},
    Column{"stored_false_contacts", stored_count_of<&oracle::ErrorCounts::false_contacts>},
    Column{"stored_max_distance_error_of_diagonal",
           [](Row row) {
             return row.rounded_scene_counts
                        ? exactly(row.rounded_scene_counts->max_distance_error_of_diagonal)
                        : "";
           }},
    Column{"wrong_side", count_of<&oracle::ErrorCounts::wrong_side>},
    Column{"prepare_ns_p50", prepare_of<&measurement::LatencySummary::p50>},
    Column{"prepare_ns_p999", p999_in<&R::prepare>},
    Column{"prepare_ns_max", prepare_of<&measurement::LatencySummary::max>},
    Column{"ns_undisturbed", undisturbed_of<&measurement::UndisturbedTime::ns>},
    Column{"ns_undisturbed_low", undisturbed_of<&measurement::UndisturbedTime::low>},
    Column{"ns_undisturbed_high", undisturbed_of<&measurement::UndisturbedTime::high>},
    Column{"disturbed_share", throughput_of<&measurement::ThroughputResult::disturbed_share>},
    Column{"decisions_checksum",
           [](Row row) { return row.decisions_checksum ? support::hex(*row.decisions_checksum) : ""; }},
    Column{"judged", count_of<&oracle::ErrorCounts::judged>},
    Column{"beyond_tolerance", count_of<&oracle::ErrorCounts::beyond_tolerance>},
    Column{"rounding", count_of<&oracle::ErrorCounts::rounding>},
};

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char character : text) {
    if (character == '"') quoted += '"';
    quoted += character;
  }
  return quoted + '"';
}

std::vector<std::string> results_columns() {
  std::vector<std::string> names{"schema", "run_id"};
  for (const Column& column : columns) names.emplace_back(column.name);
  return names;
}

std::vector<std::string> results_fields(const std::string& run_id, const measurement::ResultRow& row) {
  std::vector<std::string> fields{std::to_string(results_schema), run_id};
  for (const Column& column : columns) fields.push_back(column.value(row));
  return fields;
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += ',';
    line += csv_field(fields[i]);
  }
  return line + '\n';
}

std::string results_csv(const std::string& run_id, const std::vector<measurement::ResultRow>& rows) {
  std::string csv = csv_line(results_columns());
  for (const measurement::ResultRow& row : rows) csv += csv_line(results_fields(run_id, row));
  return csv;
}

}  // namespace touchmark::bench::results
