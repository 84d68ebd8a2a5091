#include "bench/results/validation/column_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "bench/results/results_csv.h"
#include "bench/support/numbers.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::results::validation {
namespace {

bool is_anything(std::string_view) { return true; }
bool is_schema(std::string_view text) { return text == std::to_string(results_schema); }
bool is_count(std::string_view text) { return support::parse_count(text).has_value(); }
bool is_above_zero_count(std::string_view text) { return is_count(text) && *support::parse_count(text) > 0; }
bool is_query(std::string_view text) { return workload::query_named(text).has_value(); }

bool is_length(std::string_view text) {
  const std::optional<double> value = support::parse_number(text);
  return value && *value >= 0;
}

bool is_finite(std::string_view text) {
  return is_length(text) && std::isfinite(*support::parse_number(text));
}
bool is_above_zero(std::string_view text) { return is_finite(text) && *support::parse_number(text) > 0; }

bool is_angle(std::string_view text) {
  constexpr double rounding = 1e-9;  // of the conversion from radians
  return is_finite(text) && *support::parse_number(text) <= 180 + rounding;
}

bool is_share(std::string_view text) { return is_finite(text) && *support::parse_number(text) <= 1; }

bool is_bit(std::string_view text) { return text == "0" || text == "1"; }

bool is_guarantee(std::string_view text) {
  return text == "exact" || text == "conservative" || text == "approximate";
}

/// "key=value,key=value".
bool is_options(std::string_view text) {
  while (!text.empty()) {
    const std::string_view option = text.substr(0, text.find(','));
    const std::size_t equals = option.find('=');
    if (equals == 0 || equals == std::string_view::npos || equals + 1 == option.size()) return false;
    if (option.size() == text.size()) return true;
    text.remove_prefix(option.size() + 1);
  }
  return false;  // after a comma comes nothing
}

bool is_status(std::string_view text) {
  constexpr std::array words{"ok", "unsupported", "timeout", "checksum mismatch"};
  constexpr std::array beginnings{"refused: ", "crashed:", "skipped: "};
  const auto begins = [&](std::string_view begin) { return text.starts_with(begin) && text != begin; };
  return std::find(words.begin(), words.end(), text) != words.end() ||
         std::any_of(beginnings.begin(), beginnings.end(), begins);
}

constexpr std::string_view count = "is not a whole number of 0 or more";
constexpr std::string_view length = "is not a number of 0 or more, or inf";
constexpr std::string_view amount = "is not a finite number of 0 or more";
constexpr std::string_view time = "is not a finite number above 0";

constexpr ColumnRule counted(std::string_view name, Presence presence) {
  return {name, presence, &is_count, count};
}
constexpr ColumnRule measured(std::string_view name, Presence presence) {
  return {name, presence, &is_finite, amount};
}
constexpr ColumnRule ranged(std::string_view name, Presence presence) {
  return {name, presence, &is_length, length};
}
constexpr ColumnRule text(std::string_view name) { return {name, Presence::always, &is_anything, ""}; }
constexpr ColumnRule clocked(std::string_view name) { return {name, Presence::timed, &is_above_zero, time}; }

constexpr std::array rules{
    ColumnRule{"schema", Presence::always, &is_schema, "is not 1"},
    text("run_id"),
    text("detector"),
    ColumnRule{"options", Presence::optional, &is_options, "is not key=value,key=value"},
    text("mesh"),
    counted("triangles", Presence::always),
    text("trajectory"),
    ColumnRule{"query", Presence::always, &is_query, "is not one of touches, nearest, sweep"},
    counted("steps", Presence::always),
    ranged("radius", Presence::always),
    ranged("reach", Presence::always),
    ColumnRule{"guarantee", Presence::judged, &is_guarantee,
               "is not one of exact, conservative, approximate"},
    counted("missed", Presence::judged),
    counted("false_contacts", Presence::judged),
    counted("wrong_triangle", Presence::judged),
    ranged("max_distance_error", Presence::judged),
    ranged("max_distance_error_ulp", Presence::judged),
    ColumnRule{"max_normal_angle_deg", Presence::judged, &is_angle, "is not an angle from 0 to 180"},
    counted("unresolved", Presence::judged),
    ColumnRule{
        "status", Presence::always, &is_status,
        "is not ok, unsupported, timeout, checksum mismatch, refused: WHY, skipped: WHY or crashed:HOW"},
    clocked("ns_per_query"),
    measured("ns_p50", Presence::timed),
    measured("ns_p90", Presence::timed),
    measured("ns_p99", Presence::timed),
    measured("ns_p999", Presence::optional),  // wanted from 1,000 steps on: results_check.cpp
    measured("ns_max", Presence::timed),
    clocked("update_rate_hz"),
    counted("deadline_misses_1khz", Presence::timed),
    counted("longest_miss_run_1khz", Presence::timed),
    measured("build_ms", Presence::built),
    measured("first_answer_ms", Presence::built),
    counted("bytes", Presence::judged),
    counted("heap_bytes", Presence::built),
    measured("work_mean", Presence::optional),
    counted("work_max", Presence::optional),
    ColumnRule{"repetitions", Presence::timed, &is_above_zero_count, "is not a whole number above 0"},
    clocked("ns_per_query_min"),
    measured("ns_per_query_mad", Presence::timed),
    clocked("ns_per_query_first_pass"),
    counted("deadline_misses_4khz", Presence::timed),
    counted("longest_miss_run_4khz", Presence::timed),
    counted("deadline_misses_10khz", Presence::timed),
    counted("longest_miss_run_10khz", Presence::timed),
    measured("clock_cost_ns", Presence::timed),
    ranged("max_distance_error_of_diagonal", Presence::judged),
    counted("beyond_bound", Presence::judged),
    counted("wrong_point", Presence::judged),
    counted("wrong_normal", Presence::judged),
    counted("malformed", Presence::judged),
    measured("cpu_ns_per_query", Presence::timed),
    ColumnRule{"answers_checksum", Presence::judged, &support::is_hex, "is not 16 hexadecimal digits"},
    measured("cells_mean", Presence::optional),
    measured("spheres_mean", Presence::optional),
    measured("boxes_mean", Presence::optional),
    measured("triangles_mean", Presence::optional),
    counted("exact_decisions", Presence::optional),
    ColumnRule{"decides_exactly", Presence::judged, &is_bit, "is not 0 or 1"},
    counted("stored_missed", Presence::optional),
    counted("stored_false_contacts", Presence::optional),
    ranged("stored_max_distance_error_of_diagonal", Presence::optional),
    counted("wrong_side", Presence::judged),
    measured("prepare_ns_p50", Presence::optional),
    measured("prepare_ns_p999", Presence::optional),
    measured("prepare_ns_max", Presence::optional),
    clocked("ns_undisturbed"),
    clocked("ns_undisturbed_low"),
    clocked("ns_undisturbed_high"),
    ColumnRule{"disturbed_share", Presence::timed, &is_share, "is not a share from 0 to 1"},
    ColumnRule{"decisions_checksum", Presence::optional, &support::is_hex, "is not 16 hexadecimal digits"},
    counted("judged", Presence::judged),
    counted("beyond_tolerance", Presence::judged),
    counted("rounding", Presence::judged),
};

}  // namespace

std::span<const ColumnRule> column_rules() { return rules; }

}  // namespace touchmark::bench::results::validation
