#include "bench/experiments/suite/suite_report.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bench/support/grouping.h"
#include "bench/support/table.h"

namespace touchmark::bench::experiments::suite {
namespace {

struct Score {
  const char* time;
  const char* rivals;
  RivalOf rival;
};

constexpr Score scores[] = {{"mean", "exact", exact_mean},
                            {"mean", "all", any_mean},
                            {"tail", "exact", exact_tail},
                            {"tail", "all", any_tail}};

std::string two_digits(double value) { return fmt::format("{:.2f}", value); }
std::string ratio_of(const std::optional<Rival>& rival) { return rival ? two_digits(rival->ratio) : ""; }
std::string described(const SuiteRow& row) { return row.mesh + ": " + row.question(); }

/// Returns pointers to those of the rows that `is_wanted` takes.
template <class IsWanted>
std::vector<const SuiteRow*> selected(const std::vector<SuiteRow>& rows, IsWanted is_wanted) {
  std::vector<const SuiteRow*> found;
  for (const SuiteRow& row : rows)
    if (is_wanted(row)) found.push_back(&row);
  return found;
}

/// A row and the rival that is surely ahead in it by most, if any.
struct Loss {
  const SuiteRow* row;
  const Rival* rival;
};
Loss loss_of(const SuiteRow& row) {
  const Rival* worst = nullptr;
  for (const Score& score : scores) {
    const std::optional<Rival>& rival = score.rival(row);
    if (rival && rival->counts && rival->is_ahead() && (worst == nullptr || rival->ratio < worst->ratio))
      worst = &*rival;
  }
  return {&row, worst};
}

std::vector<std::string> summary_line(const std::string& ours, const std::string& caches, const Score& score,
                                      const Summary& summary) {
  return {ours,
          caches,
          score.time,
          score.rivals,
          std::to_string(summary.cells),
          two_digits(summary.geometric_mean),
          two_digits(summary.median),
          two_digits(summary.worst),
          std::to_string(summary.behind),
          std::to_string(summary.undecided),
          described(*summary.worst_row)};
}

/// Adds lines for one of ours and one state of the caches.
void add_summaries(support::Table& table, const std::vector<SuiteRow>& rows, const std::string& ours,
                   Caches caches) {
  for (const bool in_contact : {false, true}) {
    if (in_contact && caches == Caches::warm) continue;
    for (const Score& score : scores) {
      const auto counting = selected(rows, [&](const SuiteRow& row) {
        const std::optional<Rival>& rival = score.rival(row);
        return row.ours == ours && row.caches == caches && rival && rival->counts &&
               (!in_contact || row.cell.is_in_contact());
      });
      const std::optional<Summary> summary = summary_of(counting, score.rival);
      if (!summary) continue;
      const std::string name(name_of(caches));
      table.add(summary_line(ours, in_contact ? name + " in contact" : name, score, *summary));
    }
  }
}

}  // namespace

std::string summary_table(const std::vector<SuiteRow>& rows) {
  support::Table table({"ours", "caches", "time", "rivals", "cells", "geometric mean", "median", "worst",
                        "behind", "undecided", "worst in"});
  for (const auto& [ours, _] : support::grouped_by(rows, [](const SuiteRow& row) { return row.ours; }))
    for (const Caches caches : {Caches::warm, Caches::l2, Caches::cold})
      add_summaries(table, rows, ours, caches);
  std::string text = "fastest rival's time over ours: above 1 we are ahead\n" + table.text();
  const auto unmeasured = selected(
      rows, [](const SuiteRow& row) { return row.ours == best_of_ours && row.status == "not measured"; });
  if (!unmeasured.empty())
    text += fmt::format("{} planned cells were not measured (each state of the caches counts apart)\n",
                        unmeasured.size());
  const auto stress = selected(rows, [](const SuiteRow& row) {
    return row.ours == best_of_ours && row.cell.stress && row.mean.exact;
  });
  if (const std::optional<Summary> summary = summary_of(stress, exact_mean))
    text += fmt::format(
        "stress, in no score: {} cells, geometric mean {:.2f} against exact rivals, behind in {}, worst "
        "{:.2f} in {}\n",
        summary->cells, summary->geometric_mean, summary->behind, summary->worst,
        described(*summary->worst_row));
  return text;
}

std::string list_of_uncounted(const std::vector<SuiteRow>& rows, std::size_t most) {
  support::Table table({"cell", "time", "ours ns", "rival ns", "floor ns", "ratio"});
  std::size_t found = 0;
  for (const SuiteRow* const row :
       selected(rows, [](const SuiteRow& one) { return one.ours == best_of_ours && !one.cell.stress; })) {
    for (const auto& [time, standing] : {std::pair{"mean", &row->mean}, std::pair{"tail", &row->tail}}) {
      if (!standing->exact || standing->exact->counts || ++found > most) continue;
      table.add({described(*row), time, fmt::format("{:.4g}", *standing->ns),
                 fmt::format("{:.4g}", standing->exact->ns), fmt::format("{:.4g}", row->floor_ns),
                 ratio_of(standing->exact)});
    }
  }
  if (found == 0) return "";
  std::string text = fmt::format(
      "{} times too short to be compared with those of exact rivals: both means below {:g} ns, tails less "
      "than {:g} ns apart, or within {:g} ns of the floor\n{}",
      found, min_mean_ns, min_tail_difference_ns, min_above_floor_ns, table.text());
  if (found > most) text += fmt::format("and {} more, in suite.csv\n", found - most);
  return text;
}

std::string list_of_losses(const std::vector<SuiteRow>& rows, std::size_t most) {
  std::vector<Loss> lost;
  for (const SuiteRow& row : rows) {
    const Loss loss = loss_of(row);
    if (row.ours == best_of_ours && loss.rival != nullptr) lost.push_back(loss);
  }
  if (lost.empty()) return "no rival is ahead of the best of ours in any cell\n";
  std::ranges::stable_sort(lost, {}, [](const Loss& loss) { return loss.rival->ratio; });
  support::Table table({"cell", "mean: exact", "all", "tail: exact", "all", "ours", "rival", ""});
  for (std::size_t i = 0; i < std::min(most, lost.size()); ++i) {
    const SuiteRow& row = *lost[i].row;
    table.add({described(row), ratio_of(row.mean.exact), ratio_of(row.mean.any), ratio_of(row.tail.exact),
               ratio_of(row.tail.any), row.form, lost[i].rival->contestant,
               row.conclusive ? "" : "inconclusive"});
  }
  std::string text =
      fmt::format("{} cells in which a rival is ahead of the best of ours\n{}", lost.size(), table.text());
  if (lost.size() > most) text += fmt::format("and {} more, in suite.csv\n", lost.size() - most);
  return text;
}

}  // namespace touchmark::bench::experiments::suite
