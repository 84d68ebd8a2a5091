#include "bench/experiments/choose/choose_report.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "bench/measurement/steadiness.h"
#include "bench/support/table.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::choose {
namespace {

std::string figure(double value) {
  return value >= 100 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}
std::string us(double ns) { return figure(ns / 1e3); }
std::string megabytes(double bytes) { return figure(bytes / 1e6); }

std::vector<std::string> cells_of(const Asked& asked, const Candidate& candidate) {
  const std::string why = why_not(candidate, asked.limits);
  std::vector<std::string> cells{candidate.contestant(), why.empty() ? "yes" : "no"};
  if (candidate.times) {
    const QueryTimes& times = *candidate.times;
    cells.insert(cells.end(),
                 {figure(margin_usual(times, asked.limits)), figure(margin_worst(times, asked.limits)),
                  us(times.warm_p999), us(times.warm_max), us(times.cold_p50), us(times.cold_p99),
                  us(times.cold_max), times.motion});
  } else {
    cells.insert(cells.end(), 8, "");
  }
  cells.push_back(candidate.build_ms ? figure(*candidate.build_ms) : "");
  cells.push_back(candidate.bytes ? megabytes(static_cast<double>(*candidate.bytes)) : "");
  cells.push_back(why);
  return cells;
}

/// Why the first of two candidates that hold stands before the second.
std::string compared(const Candidate& first, const Candidate& second) {
  const double ratio = second.times->usual() / first.times->usual();
  if (ratio > measurement::resolution)
    return fmt::format("takes {:.1f} times as long ({} us)", ratio, us(second.times->usual()));
  const std::string alike = fmt::format("is not told from it by time ({} us)", us(second.times->usual()));
  if (first.bytes && second.bytes && *first.bytes != *second.bytes)
    return fmt::format("{}, and takes {} MB instead of {}", alike,
                       megabytes(static_cast<double>(*second.bytes)),
                       megabytes(static_cast<double>(*first.bytes)));
  return alike;
}

std::string none_holds(const Asked& asked, const std::vector<Candidate>& candidates) {
  const Candidate* nearest = nullptr;
  for (const Candidate& candidate : candidates) {
    if (candidate.status != "ok" || !candidate.claims_exactness || candidate.wrong > 0 || !candidate.times)
      continue;
    if (nearest == nullptr || candidate.times->usual() < nearest->times->usual()) nearest = &candidate;
  }
  if (nearest == nullptr) return "none holds: no candidate was right and timed\n";
  return fmt::format(
      "none holds. The fastest that is right: {}, {} us where a query may take {} us, {} MB: {}\n",
      nearest->contestant(), us(nearest->times->usual()), us(asked.limits.budget_ns()),
      megabytes(static_cast<double>(nearest->bytes.value_or(0))), why_not(*nearest, asked.limits));
}

}  // namespace

std::string asked_text(const Asked& asked) {
  const workload::Workload& workload = asked.workload;
  std::string motions;
  for (const std::string& name : workload.trajectories) motions += (motions.empty() ? "" : ", ") + name;
  const Limits& limits = asked.limits;
  std::string text =
      fmt::format("{}; motions: {}\n", workload::question_text(workload, asked.query), motions);
  text += fmt::format("a query may take {:g} % of a tick at {:g} Hz: {} us", 100 * limits.share,
                      limits.rate_hz, us(limits.budget_ns()));
  if (limits.max_bytes) text += fmt::format("; a detector may take {} MB", megabytes(*limits.max_bytes));
  return text + '\n';
}

std::string candidate_table(const Asked& asked, const std::vector<Candidate>& candidates) {
  support::Table table({"candidate", "holds", "margin", "at worst", "warm p99.9 us", "max", "cold p50 us",
                        "p99", "max", "slowest on", "build ms", "MB", "why not"});
  const std::vector<std::size_t> ranked = ranking(candidates, asked.limits);
  for (const std::size_t i : ranked) table.add(cells_of(asked, candidates[i]));
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (std::ranges::find(ranked, i) == ranked.end()) table.add(cells_of(asked, candidates[i]));
  return table.text();
}

std::string recommendation(const Asked& asked, const std::vector<Candidate>& candidates) {
  const std::vector<std::size_t> ranked = ranking(candidates, asked.limits);
  if (ranked.empty()) return none_holds(asked, candidates);
  const Candidate& best = candidates[ranked.front()];
  const QueryTimes& times = *best.times;
  std::string text = fmt::format(
      "recommended: {}\n"
      "reason: no wrong answer among {}; at most {} us for 99.9 % of warm queries and {} us for 99 % of "
      "those with all caches emptied ({}), {} times within the share; {} MB, built in {} ms\n",
      best.contestant(), best.judged, us(times.warm_p999), us(times.cold_p99), times.motion,
      figure(margin_usual(times, asked.limits)), megabytes(static_cast<double>(best.bytes.value_or(0))),
      figure(best.build_ms.value_or(0)));
  if (margin_worst(times, asked.limits) < 1)
    text += fmt::format(
        "note: the slowest query took {} us, over the share; touchmark servo tells whether a loop misses "
        "ticks\n",
        us(times.worst()));
  if (ranked.size() == 1) return text + "runner-up: none, no other candidate holds\n";
  const Candidate& second = candidates[ranked[1]];
  return text + fmt::format("runner-up: {}, which {}\n", second.contestant(), compared(best, second));
}

}  // namespace touchmark::bench::experiments::choose
