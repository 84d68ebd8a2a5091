#include "bench/experiments/suite/suite_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiments/suite/suite_csv.h"
#include "bench/experiments/suite/suite_score.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::experiments::suite {

namespace validation = results::validation;

namespace {

constexpr double rounding = 1e-5;  // numbers are written with six digits

struct Time {
  std::string ours;
  std::array<const char*, 2> rivals;  ///< the prefixes of the exact one's columns and of any's
};
const std::array<Time, 2> times{Time{"ns", {"exact", "any"}}, Time{"tail_ns", {"exact_tail", "any_tail"}}};

class SuiteCheck {
 public:
  SuiteCheck(const validation::CsvTable& table, const nlohmann::json* run, validation::Faults& faults)
      : table_(table), run_(run), faults_(faults) {}

  void check() {
    const std::vector<std::string> names = results::names_of(suite_columns());
    // Files of version 0.2 end before the sections.
    const auto fewest = static_cast<std::size_t>(std::ranges::find(names, "section") - names.begin());
    if (!validation::begins_with_columns(table_, names, fewest, faults_)) return;
    for (const validation::CsvRecord& record : table_.records) {
      if (record.fields.size() != table_.header.size()) continue;  // check_form has said so
      row_ = &record;
      for (const auto& column : suite_columns())
        validation::check_field(table_, record, column.name, column.presence, column.kind, false, faults_);
      check_run_id();
      check_status();
      for (const Time& time : times) check_ratios(time);
      check_once();
    }
    check_best();
  }

 private:
  std::string field(const std::string& column) const { return table_.field(*row_, column); }
  std::optional<double> number(const std::string& column) const {
    return support::parse_number(field(column));
  }
  void fault(const std::string& column, const std::string& wrong) {
    faults_.push_back({table_.path, row_->line, column, field(column), wrong});
  }

  void check_run_id() {
    if (run_ == nullptr || !run_->is_object()) return;
    const nlohmann::json id = run_->value("run_id", nlohmann::json());
    if (id.is_string() && id.get<std::string>() != field("run_id"))
      fault("run_id", fmt::format("is not run.json's {}", id.get<std::string>()));
  }

  void check_status() {
    const bool ok = field("status") == "ok";
    for (const char* const column : {"form", "ns"})
      if (field(column).empty() == ok)
        fault(column, ok ? "must not be empty where the status is ok" : "must be empty");
  }

  /// A ratio is that of its times, and the fastest of all is no slower than the fastest exact one.
  void check_ratios(const Time& time) {
    for (const std::string rival : time.rivals) {
      const std::optional<double> ratio = number(rival + "_ratio"), ours = number(time.ours),
                                  ns = number(rival + "_rival_ns");
      if (ratio.has_value() != ns.has_value() || (ratio && !ours))
        fault(rival + "_ratio", "does not go with the times");
      const double floor = number("floor_ns").value_or(0);
      if (ratio && ours && ns && !is_ratio(*ratio, *ns, *ours, floor))
        fault(rival + "_ratio", fmt::format("is not {}_rival_ns / {}, both less floor_ns", rival, time.ours));
      const std::optional<double> low = number(rival + "_ratio_low"), high = number(rival + "_ratio_high");
      if (ratio && low && high && !(*low <= *ratio * (1 + rounding) && *ratio <= *high * (1 + rounding)))
        fault(rival + "_ratio", "is not between its bounds");
      if (field(rival + "_counts") == "1" && field("section") == "stress")
        fault(rival + "_counts", "must be 0 in the stress");
    }
    const std::string exact = std::string(time.rivals[0]) + "_ratio",
                      any = std::string(time.rivals[1]) + "_ratio";
    const std::optional<double> of_exact = number(exact), of_any = number(any);
    if (of_exact && !of_any) fault(any, "must not be empty where an exact rival has a time");
    if (of_exact && of_any && *of_any > *of_exact * (1 + rounding))
      fault(any, fmt::format("is above {} {}", exact, field(exact)));
  }

  /// True if these times have that ratio. Where one is near the floor, rounding of the times shows in it.
  static bool is_ratio(double ratio, double theirs, double ours, double floor) {
    const double above = above_floor(theirs, floor), ours_above = above_floor(ours, floor);
    const double error = rounding * (2 + theirs / above + ours / ours_above);
    return std::abs(above / ours_above / ratio - 1) <= error || std::min(above, ours_above) < 2;
  }

  std::string cell() const {
    std::string key;
    for (const char* const column : {"mesh", "trajectory", "query", "reach", "caches"})
      key += field(column) + '\x1f';
    return key;
  }

  void check_once() {
    if (!seen_.insert(cell() + field("ours")).second) fault("ours", "has this cell twice");
    const std::optional<double> ns = number("ns");
    if (!ns) return;
    Cell& here = cells_[cell()];
    if (field("ours") == best_of_ours) {
      here.best = row_;
    } else {
      here.least = here.least ? std::min(*here.least, *ns) : *ns;
    }
  }

  void check_best() {
    for (const auto& [_, cell] : cells_) {
      if (!cell.least) continue;
      row_ = cell.best;
      if (row_ != nullptr && number("ns") != cell.least) fault("ns", "is not the least of ours in this cell");
    }
  }

  struct Cell {
    std::optional<double> least;                  ///< the fastest of ours takes
    const validation::CsvRecord* best = nullptr;  ///< the row that says so
  };

  const validation::CsvTable& table_;
  const nlohmann::json* run_;
  validation::Faults& faults_;
  const validation::CsvRecord* row_ = nullptr;
  std::set<std::string> seen_;
  std::map<std::string, Cell> cells_;
};

}  // namespace

void check_suite(const validation::CsvTable& table, const nlohmann::json* run, validation::Faults& faults) {
  SuiteCheck(table, run, faults).check();
}

}  // namespace touchmark::bench::experiments::suite
