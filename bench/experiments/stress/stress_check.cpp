#include "bench/experiments/stress/stress_check.h"

#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiments/stress/stress_csv.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::experiments::stress {

namespace validation = results::validation;

namespace {

/// Columns that count probes, each at most once.
constexpr std::array of_probes{"missed",           "false_contacts", "wrong_triangle", "beyond_bound",
                               "wrong_point",      "wrong_normal",   "malformed",      "unresolved",
                               "beyond_tolerance", "rounding",       "wrong_side"};
constexpr std::array errors{"max_distance_error", "max_distance_error_of_diagonal", "max_distance_error_ulp"};

class StressCheck {
 public:
  StressCheck(const validation::CsvTable& table, const nlohmann::json* run, validation::Faults& faults)
      : table_(table), run_(run), faults_(faults) {}

  void check() {
    const std::vector<std::string> names = results::names_of(stress_columns());
    if (!validation::begins_with_columns(table_, names, names.size() - appended_stress_columns, faults_))
      return;
    for (const validation::CsvRecord& record : table_.records) {
      if (record.fields.size() != table_.header.size()) continue;  // check_form has said so
      row_ = &record;
      for (const auto& column : stress_columns())
        validation::check_field(table_, record, column.name, column.presence, column.kind, false, faults_);
      check_run_id();
      check_numbers();
      check_status();
    }
  }

 private:
  void check_run_id() {
    if (run_ == nullptr || !run_->is_object()) return;
    const std::string id = run_->value("run_id", nlohmann::json()).dump();
    expect('"' + field("run_id") + '"' == id, "run_id", fmt::format("is not run.json's {}", id));
  }

  void check_numbers() {
    const std::uint64_t probes = count("probes");
    for (const char* column : of_probes)
      expect(count(column) <= probes, column, fmt::format("is above probes {}", probes));
    for (const char* column : errors)
      expect(!field(column).empty() || probes == 0, column, "must not be empty where there are probes");
  }

  void check_status() {
    const std::string status = field("status");
    const bool wrong = count("missed") + count("false_contacts") + count("malformed") > 0;
    const bool inexact =
        count("wrong_triangle") + count("beyond_bound") + count("wrong_point") + count("wrong_normal") > 0;
    if (status == "ok")
      expect(!wrong && !inexact && count("probes") > 0, "status", "is not so by its own counts");
    if (status == "inexact") expect(!wrong && inexact, "status", "is not so by its own counts");
    if (status == "wrong") expect(wrong, "status", "is not so by its own counts");
    if (status == "crashed") expect(count("crashes") > 0, "status", "is not so by its own counts");
    if (status == "timeout") expect(count("timeouts") > 0, "status", "is not so by its own counts");
    if (status == "refused") expect(count("refusals") > 0, "status", "is not so by its own counts");
  }

  std::string field(const std::string& column) const { return table_.field(*row_, column); }
  std::uint64_t count(const std::string& column) const {
    return support::parse_count(field(column)).value_or(0);
  }
  void expect(bool right, const std::string& column, const std::string& wrong) {
    if (!right) faults_.push_back({table_.path, row_->line, column, field(column), wrong});
  }

  const validation::CsvTable& table_;
  const nlohmann::json* run_;
  validation::Faults& faults_;
  const validation::CsvRecord* row_ = nullptr;
};

}  // namespace

void check_stress(const validation::CsvTable& table, const nlohmann::json* run, validation::Faults& faults) {
  StressCheck(table, run, faults).check();
}

}  // namespace touchmark::bench::experiments::stress
