#include "bench/verification_report.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "bench/query_name.h"
#include "bench/text_table.h"

namespace touchmark::bench {
namespace {

/// All rows of one contestant together.
struct Summary {
  std::string contestant;
  std::string guarantee;
  Tally tally;
  std::size_t unsupported = 0;
  std::size_t refused = 0;
  std::size_t crashed = 0;
  std::size_t timed_out = 0;
  std::size_t broken = 0;
};

bool answered(const ResultRow& row) { return row.status == "ok"; }
bool declined(const ResultRow& row) {
  return row.status == "unsupported" || row.status.starts_with("refused");
}

void add(Summary& summary, const ResultRow& row) {
  if (row.tally) summary.tally += *row.tally;
  if (row.accuracy) summary.guarantee = guarantee_name(row);
  summary.unsupported += row.status == "unsupported" ? 1 : 0;
  summary.refused += row.status.starts_with("refused") ? 1 : 0;
  summary.crashed += row.status.starts_with("crashed") ? 1 : 0;
  summary.timed_out += row.status == "timeout" ? 1 : 0;
  summary.broken += claim_is_broken(row) ? 1 : 0;
}

std::vector<Summary> summarize(const std::vector<ResultRow>& rows) {
  std::vector<Summary> summaries;
  for (const ResultRow& row : rows) {
    const std::string name = row.contestant();
    auto found = std::find_if(summaries.begin(), summaries.end(),
                              [&](const Summary& summary) { return summary.contestant == name; });
    if (found == summaries.end()) {
      summaries.emplace_back().contestant = name;
      found = summaries.end() - 1;
    }
    add(*found, row);
  }
  return summaries;
}

bool without_fault(const ResultRow& row) {
  if (declined(row)) return true;
  if (!answered(row) || !row.tally) return false;
  const Tally& tally = *row.tally;
  return tally.missed + tally.false_contacts + tally.wrong_triangle + answers_off(tally) == 0;
}

std::string failure(const ResultRow& row) {
  std::string line = fmt::format("{} {}: {}, {}, {}: ", claim_is_broken(row) ? "BROKEN" : "faulty",
                                 row.contestant(), row.mesh, row.trajectory, name_of(row.query));
  if (!answered(row)) return line + row.status;
  const Tally& tally = *row.tally;
  line += fmt::format(
      "of {} {} missed, {} false, {} wrong triangle, {} off, largest error {:.3g} of the diagonal",
      tally.judged, tally.missed, tally.false_contacts, tally.wrong_triangle, answers_off(tally),
      tally.max_distance_error_of_diagonal);
  return line;
}

}  // namespace

bool claim_is_broken(const ResultRow& row) {
  if (row.broke_its_word()) return true;
  const bool claims = row.accuracy && row.accuracy->guarantee == Guarantee::exact;
  return claims && !answered(row) && !declined(row);
}

std::string verification_table(const std::vector<ResultRow>& rows) {
  TextTable table({"detector", "guarantee", "answers", "missed", "false", "wrong", "off", "unresolved",
                   "error/diag", "unsupported", "refused", "crashed", "timeout", "verdict"});
  for (const Summary& one : summarize(rows)) {
    const Tally& tally = one.tally;
    table.add(
        {one.contestant, one.guarantee, fmt::format("{}", tally.judged), fmt::format("{}", tally.missed),
         fmt::format("{}", tally.false_contacts), fmt::format("{}", tally.wrong_triangle),
         fmt::format("{}", answers_off(tally)), fmt::format("{}", tally.unresolved),
         fmt::format("{:.2g}", tally.max_distance_error_of_diagonal), fmt::format("{}", one.unsupported),
         fmt::format("{}", one.refused), fmt::format("{}", one.crashed), fmt::format("{}", one.timed_out),
         one.broken == 0 ? "as claimed" : "BROKEN"});
  }
  return table.text();
}

std::string list_of_failures(const std::vector<ResultRow>& rows, std::size_t most) {
  std::vector<const ResultRow*> failures;
  for (const ResultRow& row : rows) {
    if (!without_fault(row)) failures.push_back(&row);
  }
  // Broken claims first: they are what the exit status is about.
  std::stable_partition(failures.begin(), failures.end(),
                        [](const ResultRow* row) { return claim_is_broken(*row); });
  std::string text;
  for (std::size_t i = 0; i < std::min(most, failures.size()); ++i) text += failure(*failures[i]) + '\n';
  if (failures.size() > most) text += fmt::format("and {} more\n", failures.size() - most);
  return text;
}

}  // namespace touchmark::bench
