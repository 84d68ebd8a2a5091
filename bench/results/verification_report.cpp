#include "bench/results/verification_report.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "bench/support/failures.h"
#include "bench/support/grouping.h"
#include "bench/support/system/available_memory.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::results {
namespace {

bool answered(const measurement::ResultRow& row) { return row.status == "ok"; }
constexpr std::string_view refusal = "refused: ";
bool declined(const measurement::ResultRow& row) {
  return row.status == "unsupported" || row.status.starts_with(refusal) ||
         row.status.starts_with("skipped: ");
}

std::vector<Summary> summarize(const std::vector<measurement::ResultRow>& rows) {
  std::vector<Summary> contestants;
  for (const auto& [name, of_it] :
       support::grouped_by(rows, [](const measurement::ResultRow& row) { return row.contestant(); })) {
    Summary& summary = contestants.emplace_back();
    summary.contestant = name;
    for (const measurement::ResultRow* row : of_it) {
      summary.add(*row);
      summary.broken = summary.broken || claim_is_broken(*row);
    }
  }
  return contestants;
}

bool without_fault(const measurement::ResultRow& row) {
  if (declined(row)) return true;
  if (!answered(row) || !row.counts) return false;
  return !row.counts->charged();
}

std::string failure(const measurement::ResultRow& row) {
  std::string line = fmt::format("{} {}: {}, {}, {}: ", claim_is_broken(row) ? "BROKEN" : "faulty",
                                 row.contestant(), row.mesh, row.trajectory, workload::name_of(row.query));
  if (!answered(row)) return line + row.status;
  const oracle::ErrorCounts& counts = *row.counts;
  return line + fmt::format("of {} answers {}; largest distance error {:.3g} of the diagonal", counts.judged,
                            ground_truth::charges_of(counts), counts.max_distance_error_of_diagonal);
}

/// Each of the row's wrong answers, and the command that repeats it.
std::string wrong_answer_lines(const measurement::ResultRow& row) {
  std::string text;
  for (const ground_truth::WrongAnswer& wrong : row.wrong) {
    text += fmt::format("  {}\n", ground_truth::described(wrong));
    if (!row.repeat.empty()) text += fmt::format("    {}{}\n", row.repeat, wrong.step);
  }
  return text;
}

}  // namespace

bool claim_is_broken(const measurement::ResultRow& row) {
  if (row.violates_guarantee()) return true;
  return row.claims_exactness() && !answered(row) && !declined(row);
}

std::string_view verdict_on(bool broken, std::uint64_t judged) noexcept {
  if (broken) return "BROKEN";
  return judged == 0 ? "nothing judged" : "as claimed";
}

bool is_short_of_memory(const measurement::ResultRow& row) {
  return row.status.starts_with(refusal) && row.status.substr(refusal.size()).starts_with(support::no_memory);
}

std::string judged_answers(const std::vector<measurement::ResultRow>& rows) {
  std::uint64_t judged = 0;
  for (const measurement::ResultRow& row : rows) judged += row.counts ? row.counts->judged : 0;
  return fmt::format("{} answers judged exactly\n", judged);
}

void Summary::add(const measurement::ResultRow& row) {
  if (row.counts) counts += *row.counts;
  if (row.claim()) guarantee = measurement::guarantee_name(row);
  unsupported += row.status == "unsupported" ? 1 : 0;
  refusals += row.status.starts_with("refused") ? 1 : 0;
  crashes += row.status.starts_with("crashed") ? 1 : 0;
  timeouts += row.status == "timeout" ? 1 : 0;
  if (is_short_of_memory(row) && short_of_memory.empty()) short_of_memory = row.status;
}

int status_of(const std::vector<measurement::ResultRow>& rows, bool faulty) {
  return status_of(summarize(rows), faulty);
}

int status_of(const std::vector<Summary>& summaries, bool faulty) {
  if (faulty) return support::exit_check_failed;
  std::uint64_t all_judged = 0;
  int status = support::exit_done;
  for (const auto& [contestant, of_it] :
       support::grouped_by(summaries, [](const Summary& one) { return one.contestant; })) {
    std::uint64_t judged = 0;
    std::string short_of_memory;
    for (const Summary* one : of_it) {
      judged += one->counts.judged;
      if (short_of_memory.empty()) short_of_memory = one->short_of_memory;
    }
    all_judged += judged;
    if (judged > 0 || short_of_memory.empty()) continue;
    fmt::print(stderr, "touchmark: {}: nothing judged: {}\n", contestant, short_of_memory);
    status = support::exit_resources;
  }
  if (status != support::exit_done || all_judged > 0) return status;
  fmt::print(stderr, "touchmark: inconclusive: 0 answers were judged\n");
  return support::exit_inconclusive;
}

support::Table verification_table(const std::vector<measurement::ResultRow>& rows) {
  support::Table table({"detector", "guarantee", "answers", "missed", "false", "triangle", "distance",
                        "point", "normal", "side", "no number", "rounding", "unresolved", "error/diag",
                        "unsupported", "refused", "crashed", "timeout", "verdict"});
  const auto count = [](std::uint64_t value) { return fmt::format("{}", value); };
  for (const Summary& one : summarize(rows)) {
    const oracle::ErrorCounts& counts = one.counts;
    table.add({one.contestant, one.guarantee, count(counts.judged), count(counts.missed),
               count(counts.false_contacts), count(counts.wrong_triangle), count(counts.beyond_bound),
               count(counts.wrong_point), count(counts.wrong_normal), count(counts.wrong_side),
               count(counts.malformed), count(counts.rounding), count(counts.unresolved),
               fmt::format("{:.2g}", counts.max_distance_error_of_diagonal), count(one.unsupported),
               count(one.refusals), count(one.crashes), count(one.timeouts),
               std::string(verdict_on(one.broken, counts.judged))});
  }
  return table;
}

std::string list_of_failures(const std::vector<measurement::ResultRow>& rows, std::size_t most) {
  std::vector<const measurement::ResultRow*> failures;
  for (const measurement::ResultRow& row : rows)
    if (!without_fault(row)) failures.push_back(&row);
  // Broken claims first: they are what the exit status is about.
  std::stable_partition(failures.begin(), failures.end(),
                        [](const measurement::ResultRow* row) { return claim_is_broken(*row); });
  std::string text;
  std::set<std::string> reported;
  for (std::size_t i = 0; i < std::min(most, failures.size()); ++i) {
    text += failure(*failures[i]) + '\n';
    const bool is_first = !failures[i]->wrong.empty() && reported.insert(failures[i]->contestant()).second;
    if (is_first) text += wrong_answer_lines(*failures[i]);
  }
  if (failures.size() > most) text += fmt::format("and {} more\n", failures.size() - most);
  return text;
}

}  // namespace touchmark::bench::results
