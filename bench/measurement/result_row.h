/// What one contestant did on one trajectory: a row of results.csv and of the printed table.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/ground_truth/wrong_answer.h"
#include "bench/measurement/latency.h"
#include "bench/measurement/piece_times.h"
#include "bench/measurement/step_log.h"
#include "bench/oracle/judge.h"
#include "bench/support/shell_word.h"
#include "bench/workers/timing/cache_lines.h"
#include "bench/workload/answer.h"
#include "core/detector.h"

namespace touchmark::bench::measurement {

/// Fewer steps have no 99.9 %: one in a thousand of them is none.
inline constexpr std::size_t steps_for_p999 = 1000;
/// Fewer samples have no 99 %.
inline constexpr std::size_t samples_for_p99 = 100;

/// How long queries took when the trajectory was replayed without a clock inside.
struct ThroughputResult {
  double ns_per_query = 0;             ///< median of the repetitions
  double ns_per_query_min = 0;         ///< least
  double ns_per_query_mad = 0;         ///< median absolute deviation from the median
  double ns_per_query_first_pass = 0;  ///< fresh session; see Case::first_pass
  double cpu_ns_per_query = 0;         ///< median; without what other processes took of the core
  std::size_t repetitions = 0;
  UndisturbedTime undisturbed{};      ///< over the whole trajectory; what contestants are ranked by
  double disturbed_share = 0;         ///< its samples that were interrupted for over a fifth of their time
  std::uint64_t queries = 0;          ///< that a repetition asks
  std::vector<double> each_ns{};      ///< a query's time in each repetition, in their order
  std::vector<double> each_cpu_ns{};  ///< processor time, likewise
};

/// How far apart the bounds of unfinished answers are, of the diagonal, over all answers.
struct BracketSummary {
  std::uint64_t unfinished = 0;
  double p50 = 0, max = 0;
};

BracketSummary summarize_brackets(std::span<const workload::Answer> answers, double diagonal);

struct WorkResult {
  double mean = 0;  ///< cells, spheres, boxes and triangles looked at, a step
  std::uint64_t max = 0;
  Work total;                    ///< over all steps, by kind
  BracketSummary brackets = {};  ///< what a budget of work left open
};

/// Summarizes the work of at least one step; `total` is that of all of them.
inline WorkResult summarize_work(std::span<const std::uint64_t> work, const Work& total) {
  return {static_cast<double>(total.total()) / static_cast<double>(work.size()),
          *std::ranges::max_element(work), total};
}

/// Empty is what was not measured, because the contestant did not come so far.
struct ResultRow {
  std::string detector;
  std::string options;  ///< as written out: "key=value,..."
  std::string plugin;   ///< the file that has it; empty: one of the program's own
  std::string mesh;
  std::size_t triangles = 0;
  std::string trajectory;
  workload::Query query = workload::Query::nearest;
  std::size_t steps = 0;      ///< replayed, timed and verified
  double radius = 0;          ///< mesh units
  double reach = 0;           ///< mesh units
  std::string status = "ok";  ///< else unsupported, refused: ..., crashed:..., timeout, checksum mismatch

  std::optional<Guarantee>
      claimed;  ///< by the contestant's entry, so known of one that never came to be built
  std::optional<Accuracy> accuracy;           ///< as claimed once it was built
  std::optional<oracle::ErrorCounts> counts;  ///< as found
  std::optional<oracle::ErrorCounts>
      rounded_mesh_counts;  ///< by the mesh that its library keeps, where that is another
  std::optional<ThroughputResult> throughput;
  std::optional<LatencySummary> latency;
  std::optional<ColdSummary> cold_l2, cold;        ///< the second-level cache emptied; all caches
  double cold_floor_l2_ns = 0, cold_floor_ns = 0;  ///< medians with nothing asked
  std::optional<workers::CacheLines> lines;        ///< that a query touches
  std::optional<LatencySummary> prepare;           ///< between steps, where the contestant does that
  std::vector<ground_truth::WrongAnswer> wrong;    ///< the first ones of those that were charged
  std::string repeat;  ///< the command that prints the answer to a step, up to the step's number
  std::shared_ptr<const StepLog> log;  ///< null where none was asked for
  double clock_cost_ns = 0;
  double busy_s = 0;  ///< that its worker was waited for
  std::optional<double> build_ms;
  std::optional<double> first_answer_ms;  ///< build and first query
  std::optional<std::uint64_t> bytes;
  std::optional<std::uint64_t> heap_bytes;
  std::optional<WorkResult> work;
  std::optional<std::uint64_t> checksum;
  std::optional<std::uint64_t> decisions_checksum;  ///< see decisions_checksum_of

  /// Returns the words that name the contestant on a command line.
  std::string as_typed() const {
    const std::string named = "--detector " + support::quoted(contestant());
    return plugin.empty() ? named : "--plugin " + support::quoted(plugin) + ' ' + named;
  }
  std::string contestant() const { return options.empty() ? detector : detector + ":" + options; }
  std::optional<Guarantee> claim() const {
    if (accuracy) return accuracy->guarantee;
    return claimed;
  }
  bool claims_exactness() const { return claim() == Guarantee::exact; }
  /// It was judged, and did not do what it claims.
  bool violates_guarantee() const {
    return accuracy && counts && !oracle::meets_guarantee(*counts, *accuracy);
  }
};

/// What all who claim exactness must agree on: contact or none, and for `nearest` the triangle. Distances may
/// differ in their last bits. Nothing for others, and for those that name any of several triangles equally
/// near.
inline std::optional<std::uint64_t> decisions_checksum_of(workload::Query query,
                                                          std::span<const workload::Answer> answers,
                                                          const Accuracy& accuracy) {
  if (accuracy.guarantee != Guarantee::exact) return std::nullopt;
  if (query == workload::Query::nearest && !accuracy.names_exactly) return std::nullopt;
  workload::Checksum checksum;
  for (const workload::Answer& answer : answers) {
    workload::Answer decision;
    decision.found = answer.found;
    if (query == workload::Query::nearest) decision.triangle = answer.triangle;
    checksum.add(decision);
  }
  return checksum.value();
}

/// Nothing where there are no times or too few steps.
inline std::optional<double> p999_of(const ResultRow& row, const std::optional<LatencySummary>& latency) {
  if (!latency || row.steps < steps_for_p999) return std::nullopt;
  return latency->p999;
}

/// How many answers found contact with the wrong distance, point, normal or side: at least so many, since one
/// answer is counted under each of them.
inline std::uint64_t answers_off(const oracle::ErrorCounts& counts) noexcept {
  return std::max({counts.beyond_bound, counts.wrong_point, counts.wrong_normal, counts.wrong_side}) +
         counts.malformed;
}

/// As claimed; empty where it is not known.
inline std::string_view guarantee_name(std::optional<Guarantee> claim) noexcept {
  if (!claim) return "";
  switch (*claim) {
    case Guarantee::exact:
      return "exact";
    case Guarantee::conservative:
      return "conservative";
    case Guarantee::approximate:
      return "approximate";
  }
  return "";
}
inline std::string_view guarantee_name(const ResultRow& row) noexcept { return guarantee_name(row.claim()); }

}  // namespace touchmark::bench::measurement
