#include "bench/experiments/stress/stress_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiments/stress/stress_csv.h"
#include "bench/support/numbers.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::stress {

namespace validation = results::validation;

namespace {

constexpr std::array filled{"run_id", "detector", "family"};
constexpr std::array counts{"adversarial",    "meshes",       "probes",      "missed",       "false_contacts",
                            "wrong_triangle", "beyond_bound", "wrong_point", "wrong_normal", "malformed",
                            "unresolved",     "crashes",      "timeouts",    "refusals"};
/// Columns that count probes, each at most once.
constexpr std::array of_probes{"missed",      "false_contacts", "wrong_triangle", "beyond_bound",
                               "wrong_point", "wrong_normal",   "malformed",      "unresolved"};
constexpr std::array appended{"beyond_tolerance", "rounding", "wrong_side"};
constexpr std::array errors{"max_distance_error", "max_distance_error_of_diagonal", "max_distance_error_ulp"};
constexpr std::array statuses{"ok", "unsupported", "refused", "inexact", "wrong", "timeout", "crashed"};
constexpr std::array guarantees{"", "exact", "conservative", "approximate"};

template <class List>
bool is_among(const List& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

class StressCheck {
 public:
  StressCheck(const validation::CsvTable& table, const nlohmann::json* run, validation::Faults& faults)
      : table_(table), run_(run), faults_(faults) {}

  void check() {
    const std::vector<std::string> names = stress_columns();
    if (!validation::begins_with_columns(table_, {names.begin(), names.end()}, names.size() - appended.size(),
                                         faults_))
      return;
    for (const validation::CsvRecord& record : table_.records) {
      if (record.fields.size() != table_.header.size()) continue;  // check_form has said so
      row_ = &record;
      check_words();
      check_numbers();
      check_status();
    }
  }

 private:
  void check_words() {
    expect(field("schema") == std::to_string(stress_schema), "schema", "is not 1");
    for (const char* column : filled) expect(!field(column).empty(), column, "must not be empty");
    expect(workload::query_named(field("query")).has_value(), "query",
           "is not one of touches, nearest, sweep");
    expect(is_among(guarantees, field("guarantee")), "guarantee",
           "is not one of exact, conservative, approximate");
    if (run_ == nullptr || !run_->is_object()) return;
    const std::string id = run_->value("run_id", nlohmann::json()).dump();
    expect('"' + field("run_id") + '"' == id, "run_id", fmt::format("is not run.json's {}", id));
  }

  void check_numbers() {
    for (const char* column : counts)
      expect(support::parse_count(field(column)).has_value(), column, "is not a whole number of 0 or more");
    const std::uint64_t probes = count("probes");
    for (const char* column : of_probes)
      expect(count(column) <= probes, column, fmt::format("is above probes {}", probes));
    for (const char* column : appended) {
      if (!table_.has(column)) continue;
      expect(support::parse_count(field(column)).has_value(), column, "is not a whole number of 0 or more");
      expect(count(column) <= probes, column, fmt::format("is above probes {}", probes));
    }
    expect(count("adversarial") <= 1, "adversarial", "is not 0 or 1");
    for (const char* column : errors) {
      const std::optional<double> value = support::parse_number(field(column));
      expect(field(column).empty() ? probes == 0 : value && *value >= 0, column,
             "is not a number of 0 or more, or inf");
    }
    const std::optional<double> ns = support::parse_number(field("ns_per_query"));
    expect(field("ns_per_query").empty() || (ns && *ns > 0 && std::isfinite(*ns)), "ns_per_query",
           "is not a finite number above 0");
  }

  void check_status() {
    const std::string status = field("status");
    expect(is_among(statuses, status), "status", fmt::format("is not one of {}", fmt::join(statuses, ", ")));
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
