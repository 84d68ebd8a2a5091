#include "bench/results/validation/results_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/measurement/result_row.h"
#include "bench/results/results_csv.h"
#include "bench/results/validation/rows_asked.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::results::validation {
namespace {

// Times are written with six digits, so that two of them may disagree in the last.
constexpr double rounding = 1e-5;

/// The left column's number is never above the right one's.
constexpr std::array ascending{
    std::pair{"missed", "steps"},
    std::pair{"false_contacts", "steps"},
    std::pair{"wrong_triangle", "steps"},
    std::pair{"unresolved", "steps"},
    std::pair{"judged", "steps"},
    std::pair{"missed", "judged"},
    std::pair{"false_contacts", "judged"},
    std::pair{"beyond_tolerance", "judged"},
    std::pair{"rounding", "judged"},
    std::pair{"ns_per_query_min", "ns_per_query"},
    std::pair{"ns_p50", "ns_p90"},
    std::pair{"ns_p90", "ns_p99"},
    std::pair{"ns_p99", "ns_p999"},
    std::pair{"ns_p999", "ns_max"},
    std::pair{"ns_p99", "ns_max"},
    std::pair{"ns_undisturbed_low", "ns_undisturbed"},
    std::pair{"ns_undisturbed", "ns_undisturbed_high"},
    std::pair{"longest_miss_run_1khz", "deadline_misses_1khz"},
    std::pair{"longest_miss_run_4khz", "deadline_misses_4khz"},
    std::pair{"longest_miss_run_10khz", "deadline_misses_10khz"},
    std::pair{"deadline_misses_1khz", "deadline_misses_4khz"},
    std::pair{"deadline_misses_4khz", "deadline_misses_10khz"},
    std::pair{"deadline_misses_10khz", "steps"},
    std::pair{"build_ms", "first_answer_ms"},
    std::pair{"work_mean", "work_max"},
    std::pair{"cells_mean", "work_mean"},
    std::pair{"spheres_mean", "work_mean"},
    std::pair{"boxes_mean", "work_mean"},
    std::pair{"triangles_mean", "work_mean"},
    std::pair{"prepare_ns_p50", "prepare_ns_p999"},
    std::pair{"prepare_ns_p999", "prepare_ns_max"},
};

class ResultsCheck {
 public:
  ResultsCheck(const CsvTable& table, const nlohmann::json* run, Faults& faults)
      : table_(table), run_(run), faults_(faults) {
    timed_ = run != nullptr || std::any_of(table.records.begin(), table.records.end(), [&](const auto& row) {
               return is_ok(table, row) && !table.field(row, "ns_per_query").empty();
             });
  }

  void check() {
    if (!begins_with_columns(table_, names_of(results_columns()), columns_of_the_contract, faults_)) return;
    for (const CsvRecord& record : table_.records) {
      if (record.fields.size() != table_.header.size()) continue;  // check_form has said so
      row_ = &record;
      check_fields();
      check_order();
      check_rate();
      check_mean();
      check_p999();
      check_exactness();
      if (run_ != nullptr) check_against_run();
    }
    check_rows_asked(table_, run_, faults_);
    check_exact_peers(table_, faults_);
  }

 private:
  void check_fields();
  void check_order();
  void check_rate();
  void check_mean();
  void check_p999();
  void check_exactness();
  void check_against_run();
  void check_listed(const char* column, const nlohmann::json& list, const char* what);

  std::string field(const std::string& column) const { return table_.field(*row_, column); }
  void fault(std::string_view column, const std::string& wrong) {
    faults_.push_back({table_.path, row_->line, std::string(column), field(std::string(column)), wrong});
  }

  const CsvTable& table_;
  const nlohmann::json* run_;
  Faults& faults_;
  bool timed_ = false;
  const CsvRecord* row_ = nullptr;
};

void ResultsCheck::check_fields() {
  for (const auto& column : results_columns())
    check_field(table_, *row_, column.name, column.presence, column.kind, timed_, faults_);
  for (const char* const column : {"judged", "steps"}) {
    if (is_ok(table_, *row_) && field(column) == "0") fault(column, "must be above 0 where the status is ok");
  }
}

void ResultsCheck::check_order() {
  for (const auto& [low, high] : ascending) {
    const std::optional<double> less = support::parse_number(field(low)),
                                more = support::parse_number(field(high));
    if (less && more && *less > *more * (1 + rounding)) {
      fault(low, fmt::format("is above {} {}", high, field(high)));
    }
  }
}

void ResultsCheck::check_rate() {
  const std::optional<double> ns = support::parse_number(field("ns_per_query"));
  const std::optional<double> rate = support::parse_number(field("update_rate_hz"));
  if (ns && rate && std::abs(*ns * *rate / 1e9 - 1) > 2 * rounding) {
    fault("update_rate_hz", fmt::format("is not 1e9 / ns_per_query {}", field("ns_per_query")));
  }
}

/// No mean is above the maximum. The mean is of other passes than the maximum, so that where all steps take
/// equally long it may be a little, and where the row says so what interrupted them is in one and not in the
/// other.
void ResultsCheck::check_mean() {
  constexpr double between_passes = 1.25;
  const std::optional<double> most = support::parse_number(field("ns_max"));
  const std::optional<double> disturbed = support::parse_number(field("disturbed_share"));
  for (const char* const column : {"ns_per_query", "ns_undisturbed"}) {
    const std::optional<double> mean = support::parse_number(field(column));
    const bool interrupted = column == std::string_view("ns_per_query") && disturbed && *disturbed > 0;
    if (mean && most && !interrupted && *mean > between_passes * *most)
      fault(column, fmt::format("is above ns_max {}", field("ns_max")));
  }
}

/// From so many steps on there is a 99.9 %; of fewer it was told only before `ns_undisturbed` was.
void ResultsCheck::check_p999() {
  const std::optional<std::uint64_t> steps = support::parse_count(field("steps"));
  if (!steps || !is_ok(table_, *row_)) return;
  const bool enough = *steps >= measurement::steps_for_p999;
  if (enough && timed_ && field("ns_p999").empty()) fault("ns_p999", "must not be empty from 1,000 steps on");
  if (!enough && !field("ns_undisturbed").empty() && !field("ns_p999").empty())
    fault("ns_p999", "must be empty below 1,000 steps");
}

/// Whoever claims exactness and errs is no result to quote.
void ResultsCheck::check_exactness() {
  if (field("guarantee") != "exact" || !is_ok(table_, *row_)) return;
  for (const char* const column : {"missed", "false_contacts", "wrong_triangle"}) {
    const std::optional<std::uint64_t> wrong = support::parse_count(field(column));
    if (wrong && *wrong > 0) fault(column, "must be 0 where the guarantee is exact");
  }
}

/// A run.json that is not as it should be has faults of its own, so what is not there is not compared.
void ResultsCheck::check_against_run() {
  const auto expect = [&](const char* column, const nlohmann::json& value) {
    if (!value.is_string() && !value.is_number()) return;
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (field(column) != text) fault(column, fmt::format("is not run.json's {}", text));
  };
  expect("run_id", run_->value("run_id", nlohmann::json()));
  expect("query", run_->value("query", nlohmann::json()));
  const nlohmann::json meshes = run_->value("meshes", nlohmann::json());
  nlohmann::json mesh = run_->value("mesh", nlohmann::json());
  if (meshes.is_array()) {
    check_listed("mesh", meshes, "meshes");
    mesh = nullptr;
    for (const nlohmann::json& one : meshes) {
      if (one.is_object() && one.value("name", nlohmann::json()) == field("mesh")) mesh = one;
    }
  }
  if (mesh.is_object()) {
    expect("mesh", mesh.value("name", nlohmann::json()));
    expect("triangles", mesh.value("triangles", nlohmann::json()));
  }
  check_listed("trajectory", run_->value("trajectories", nlohmann::json()), "trajectories");
  check_listed("detector", run_->value("contestants", nlohmann::json()), "contestants");
}

void ResultsCheck::check_listed(const char* column, const nlohmann::json& list, const char* what) {
  if (!list.is_array()) return;
  const bool listed = std::any_of(list.begin(), list.end(), [&](const nlohmann::json& entry) {
    return entry.is_object() && entry.contains("name") && entry["name"] == field(column);
  });
  if (!listed) fault(column, fmt::format("is not among run.json's {}", what));
}

}  // namespace

void check_results(const CsvTable& table, const nlohmann::json* run, Faults& faults) {
  ResultsCheck(table, run, faults).check();
}

}  // namespace touchmark::bench::results::validation
