#include "bench/experiments/servo/servo_check.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiments/servo/servo_csv.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::experiments::servo {

namespace validation = results::validation;

namespace {

constexpr std::array percentiles{"p50", "p99", "p999", "p9999", "max"};
constexpr std::array timed{"latency_ns", "query_ns", "idle_latency_ns"};

class ServoCheck {
 public:
  ServoCheck(const validation::CsvTable& table, const validation::CsvTable* histogram,
             const nlohmann::json* run, validation::Faults& faults)
      : table_(table), histogram_(histogram), run_(run), faults_(faults) {}

  void check() {
    const std::vector<std::string> names = results::names_of(servo_columns());
    if (!validation::begins_with_columns(table_, names, names.size(), faults_)) return;
    for (const validation::CsvRecord& record : table_.records) {
      if (record.fields.size() != table_.header.size()) continue;  // check_form has said so
      row_ = &record;
      for (const auto& column : servo_columns())
        validation::check_field(table_, record, column.name, column.presence, column.kind, false, faults_);
      check_run_id();
      check_counts();
      check_times();
      check_verdict();
      if (histogram_ != nullptr) check_histogram();
    }
  }

 private:
  void check_run_id() {
    if (run_ == nullptr || !run_->is_object()) return;
    const std::string id = run_->value("run_id", nlohmann::json()).dump();
    expect('"' + field("run_id") + '"' == id, "run_id", fmt::format("is not run.json's {}", id));
  }

  void check_counts() {
    const auto at_most = [&](const char* less, const char* more) {
      expect(count(less) <= count(more), less, fmt::format("is above {} {}", more, field(more)));
    };
    at_most("missed_ticks", "ticks");
    at_most("lost_ticks", "missed_ticks");
    at_most("longest_miss_run", "missed_ticks");
    at_most("idle_missed_ticks", "idle_ticks");
    expect((count("missed_ticks") > 0) == (count("longest_miss_run") > 0), "longest_miss_run",
           "does not go with missed_ticks");
  }

  void check_times() {
    for (const std::string time : timed) {
      std::uint64_t before = 0;
      for (const char* percentile : percentiles) {
        const std::string column = time + '_' + percentile, text = field(column);
        if (text.empty()) continue;
        const std::uint64_t ns = support::parse_count(text).value_or(0);
        expect(ns >= before, column, "is below the percentile before it");
        before = ns;
      }
    }
  }

  void check_verdict() {
    const Misses misses{count("ticks"),
                        count("missed_ticks"),
                        count("idle_ticks"),
                        count("idle_missed_ticks"),
                        count("turns_missed_more"),
                        count("turns_idle_missed_more")};
    const std::optional<double> below = support::parse_number(field("miss_rate_below"));
    constexpr double digits = 1e-3;  // it is written with four
    const double bound = max_miss_rate(misses.missed, misses.ticks);
    expect(misses.ticks == 0 ? field("miss_rate_below").empty()
                             : below && std::abs(*below - bound) <= digits * bound,
           "miss_rate_below", fmt::format("is not {:.4g}, which follows from the ticks", bound));
    const std::string verdict = field("verdict");
    const std::string_view worst = name_of(Verdict::does_not_hold);
    const bool idle_too = field("status") == overrun && count("idle_overrun") == 1;
    // Wrong answers make any verdict the worst.
    expect(verdict == worst || (field("status") == "ok" && verdict == name_of(verdict_on(misses))) ||
               (idle_too && verdict == name_of(Verdict::inconclusive)),
           "verdict", "does not follow from the row");
  }

  void check_histogram() {
    for (const auto& [loop, column] : {std::pair{"detector", "ticks"}, std::pair{"idle", "idle_ticks"}}) {
      std::uint64_t ticks = 0;
      for (const validation::CsvRecord& bucket : histogram_->records) {
        const auto is = [&](const char* name, const std::string& value) {
          return histogram_->field(bucket, name) == value;
        };
        if (is("detector", field("detector")) && is("options", field("options")) &&
            is("trajectory", field("trajectory")) && is("loop", loop) && is("time", "latency"))
          ticks += support::parse_count(histogram_->field(bucket, "ticks")).value_or(0);
      }
      expect(ticks == count(column), column, fmt::format("is not the {} of servo_histogram.csv", ticks));
    }
  }

  std::string field(const std::string& column) const { return table_.field(*row_, column); }
  std::uint64_t count(const std::string& column) const {
    return support::parse_count(field(column)).value_or(0);
  }
  void expect(bool right, const std::string& column, const std::string& wrong) {
    if (!right) faults_.push_back({table_.path, row_->line, column, field(column), wrong});
  }

  const validation::CsvTable& table_;
  const validation::CsvTable* histogram_;
  const nlohmann::json* run_;
  validation::Faults& faults_;
  const validation::CsvRecord* row_ = nullptr;
};

}  // namespace

void check_servo(const validation::CsvTable& table, const validation::CsvTable* histogram,
                 const nlohmann::json* run, validation::Faults& faults) {
  ServoCheck(table, histogram, run, faults).check();
}

}  // namespace touchmark::bench::experiments::servo
