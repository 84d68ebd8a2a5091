#include "bench/experiments/servo/servo_check.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/servo/servo_csv.h"
#include "bench/results/validation/row_check.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::experiments::servo {

namespace validation = results::validation;

namespace {

constexpr std::array percentiles{"p50", "p99", "p999", "p9999", "max"};
/// Columns that files of the first releases do not have: those of proxies.
constexpr std::size_t newer_columns = 9;
constexpr std::array timed{"latency_ns", "query_ns", "idle_latency_ns"};

void check_counts(const validation::RowCheck& row) {
  const auto at_most = [&](const char* less, const char* more) {
    row.expect(row.count(less) <= row.count(more), less,
               fmt::format("is above {} {}", more, row.field(more)));
  };
  at_most("missed_ticks", "ticks");
  at_most("lost_ticks", "missed_ticks");
  at_most("longest_miss_run", "missed_ticks");
  at_most("idle_missed_ticks", "idle_ticks");
  row.expect((row.count("missed_ticks") > 0) == (row.count("longest_miss_run") > 0), "longest_miss_run",
             "does not go with missed_ticks");
}

void check_times(const validation::RowCheck& row) {
  for (const std::string time : timed) {
    std::uint64_t before = 0;
    for (const char* percentile : percentiles) {
      const std::string column = time + '_' + percentile, text = row.field(column);
      if (text.empty()) continue;
      const std::uint64_t ns = support::parse_count(text).value_or(0);
      row.expect(ns >= before, column, "is below the percentile before it");
      before = ns;
    }
  }
}

void check_verdict(const validation::RowCheck& row) {
  const Misses misses{row.count("ticks"),
                      row.count("missed_ticks"),
                      row.count("idle_ticks"),
                      row.count("idle_missed_ticks"),
                      row.count("turns_missed_more"),
                      row.count("turns_idle_missed_more")};
  const std::optional<double> below = support::parse_number(row.field("miss_rate_below"));
  constexpr double digits = 1e-3;  // it is written with four
  const double bound = max_miss_rate(misses.missed, misses.ticks);
  row.expect(misses.ticks == 0 ? row.field("miss_rate_below").empty()
                               : below && std::abs(*below - bound) <= digits * bound,
             "miss_rate_below", fmt::format("is not {:.4g}, which follows from the ticks", bound));
  const std::string verdict = row.field("verdict");
  const std::string_view worst = name_of(Verdict::does_not_hold);
  const bool idle_too = row.field("status") == overrun && row.count("idle_overrun") == 1;
  // Wrong answers make any verdict the worst.
  row.expect(verdict == worst || (row.field("status") == "ok" && verdict == name_of(verdict_on(misses))) ||
                 (idle_too && verdict == name_of(Verdict::inconclusive)),
             "verdict", "does not follow from the row");
}

/// What a proxy's rows have, and no others.
void check_proxy(const validation::RowCheck& row) {
  const bool is_proxy = row.field("proxy") == own_proxy;
  row.expect(is_proxy == (row.field("query") == proxy_step), "proxy", "does not go with query");
  const std::uint64_t judged = row.count("judged_ticks");
  for (const char* column :
       {"judged_ticks", "crossings", "violations", "contact_ticks", "stuck_ticks", "unfinished_ticks"}) {
    row.expect(row.field(column).empty() || is_proxy, column, "is of a proxy, and this row has none");
    row.expect(row.count(column) <= judged, column, fmt::format("is above judged_ticks {}", judged));
  }
  row.expect(!is_proxy || !row.is_ok() || judged + row.count("lost_ticks") >= row.count("ticks"),
             "judged_ticks", "is below the ticks that stepped the proxy");
  row.expect(row.count("crossings") + row.count("violations") == 0 ||
                 row.field("verdict") == name_of(Verdict::does_not_hold),
             "verdict", "does not follow from the crossings and violations");
}

void check_histogram(const validation::RowCheck& row, const validation::CsvTable& histogram) {
  for (const auto& [loop, column] : {std::pair{"detector", "ticks"}, std::pair{"idle", "idle_ticks"}}) {
    std::uint64_t ticks = 0;
    for (const validation::CsvRecord& bucket : histogram.records) {
      const auto is = [&](const char* name, const std::string& value) {
        return histogram.field(bucket, name) == value;
      };
      if (is("detector", row.field("detector")) && is("options", row.field("options")) &&
          is("trajectory", row.field("trajectory")) && is("loop", loop) && is("time", "latency"))
        ticks += support::parse_count(histogram.field(bucket, "ticks")).value_or(0);
    }
    row.expect(ticks == row.count(column), column,
               fmt::format("is not the {} of servo_histogram.csv", ticks));
  }
}

}  // namespace

void check_servo(const validation::CsvTable& table, const validation::CsvTable* histogram,
                 const nlohmann::json* run, validation::Faults& faults) {
  const auto columns = servo_columns();
  validation::check_rows(table, columns, columns.size() - newer_columns, faults,
                         [&](const validation::RowCheck& row) {
                           row.check_fields(columns, false);
                           row.expect_run_id(run);
                           check_counts(row);
                           check_times(row);
                           check_verdict(row);
                           if (table.has("proxy")) check_proxy(row);
                           if (histogram != nullptr) check_histogram(row, *histogram);
                         });
}

}  // namespace touchmark::bench::experiments::servo
