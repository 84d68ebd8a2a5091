#include "bench/experiments/suite/suite_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/support/grouping.h"
#include "bench/support/table.h"

namespace touchmark::bench::experiments::suite {
namespace {

struct Score {
  const char* time;
  const char* rivals;
  RatioOf ratio;
};

constexpr Score scores[] = {{"mean", "exact", exact_mean},
                            {"mean", "all", any_mean},
                            {"tail", "exact", exact_tail},
                            {"tail", "all", any_tail}};

std::string two_digits(double value) { return fmt::format("{:.2f}", value); }
std::string optional_ratio(std::optional<double> ratio) { return ratio ? two_digits(*ratio) : ""; }

/// Returns the least of a row's ratios, if any.
std::optional<double> min_ratio(const SuiteRow& row) {
  std::optional<double> least;
  for (const Score& score : scores) {
    const std::optional<double> ratio = score.ratio(row);
    if (ratio && (!least || *ratio < *least)) least = ratio;
  }
  return least;
}

std::string rival_of(const SuiteRow& row) {
  const bool by_tail = row.tail.any && (!row.mean.any || row.tail.any->ratio < row.mean.any->ratio);
  const std::optional<Rival>& rival = by_tail ? row.tail.any : row.mean.any;
  return rival ? rival->contestant : "";
}

}  // namespace

std::string summary_table(const std::vector<SuiteRow>& rows) {
  support::Table table(
      {"ours", "time", "rivals", "cells", "geometric mean", "median", "worst", "below 1", "worst in"});
  for (const auto& [ours, _] : support::grouped_by(rows, [](const SuiteRow& row) { return row.ours; })) {
    for (const Score& score : scores) {
      const std::optional<Summary> summary = summary_of(rows, ours, score.ratio);
      if (!summary) continue;
      table.add({ours, score.time, score.rivals, std::to_string(summary->cells),
                 two_digits(summary->geometric_mean), two_digits(summary->median), two_digits(summary->worst),
                 std::to_string(summary->lost),
                 summary->worst_row->mesh + ": " + summary->worst_row->question()});
    }
  }
  const auto unmeasured = std::count_if(rows.begin(), rows.end(), [](const SuiteRow& row) {
    return row.ours == best_of_ours && row.status == "not measured";
  });
  std::string text = "fastest rival's time over ours: above 1 we are ahead\n" + table.text();
  if (unmeasured > 0)
    text += fmt::format("{} planned cells were not measured (warm and cold ones count apart)\n", unmeasured);
  return text;
}

std::string list_of_losses(const std::vector<SuiteRow>& rows, std::size_t most) {
  std::vector<const SuiteRow*> lost;
  for (const SuiteRow& row : rows) {
    if (row.ours == best_of_ours && min_ratio(row).value_or(1) < 1) lost.push_back(&row);
  }
  if (lost.empty()) return "no rival is ahead of the best of ours in any cell\n";
  std::stable_sort(lost.begin(), lost.end(),
                   [](const SuiteRow* a, const SuiteRow* b) { return *min_ratio(*a) < *min_ratio(*b); });
  support::Table table({"cell", "mean: exact", "all", "tail: exact", "all", "ours", "rival", ""});
  for (std::size_t i = 0; i < std::min(most, lost.size()); ++i) {
    const SuiteRow& row = *lost[i];
    table.add({row.mesh + ": " + row.question(), optional_ratio(exact_mean(row)),
               optional_ratio(any_mean(row)), optional_ratio(exact_tail(row)), optional_ratio(any_tail(row)),
               row.form, rival_of(row), row.conclusive ? "" : "inconclusive"});
  }
  std::string text =
      fmt::format("{} cells in which a rival is ahead of the best of ours\n{}", lost.size(), table.text());
  if (lost.size() > most) text += fmt::format("and {} more, in suite.csv\n", lost.size() - most);
  return text;
}

}  // namespace touchmark::bench::experiments::suite
