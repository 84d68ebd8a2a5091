#include "bench/experiments/choose/choose_csv.h"

#include <array>

#include <fmt/format.h>

#include "bench/support/table.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::choose {
namespace {

using Line = const ChooseLine&;
namespace kinds = results::kinds;
using enum results::Presence;

template <class Number>
std::string count(Number value) {
  return fmt::format("{}", value);
}
std::string rounded(double value) { return fmt::format("{:.6g}", value); }

template <double QueryTimes::*time>
std::string of_times(Line line) {
  return line.candidate.times ? rounded((*line.candidate.times).*time) : "";
}
template <double (*margin)(const QueryTimes&, const Limits&) noexcept>
std::string of_margin(Line line) {
  return line.candidate.times ? rounded(margin(*line.candidate.times, line.asked.limits)) : "";
}

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<ChooseLine>>({
    {"schema", [](Line) { return std::to_string(choose_schema); }, always, kinds::one},
    {"run_id", nullptr, always},
    {"detector", [](Line line) { return line.candidate.detector; }, always},
    {"options", [](Line line) { return line.candidate.options; }, optional},
    {"mesh", [](Line line) { return line.asked.workload.mesh_name; }, always},
    {"triangles", [](Line line) { return count(line.asked.workload.mesh.size()); }, always,
     kinds::whole_number},
    {"query", [](Line line) { return std::string(workload::name_of(line.asked.query)); }, always,
     kinds::query},
    {"radius", [](Line line) { return count(line.asked.workload.radius); }, always, kinds::length},
    {"reach",
     [](Line line) { return count(line.asked.workload.reach.value_or(line.asked.workload.radius)); }, always,
     kinds::length},
    {"rate_hz", [](Line line) { return count(line.asked.limits.rate_hz); }, always, kinds::positive},
    {"share", [](Line line) { return count(line.asked.limits.share); }, always, kinds::share},
    {"max_bytes",
     [](Line line) {
       return line.asked.limits.max_bytes ? fmt::format("{:.0f}", *line.asked.limits.max_bytes) : "";
     },
     optional, kinds::whole_number},
    {"motions", [](Line line) { return count(line.asked.workload.trajectories.size()); }, always,
     kinds::positive_count},
    {"guarantee", [](Line line) { return std::string(line.candidate.claims_exactness ? "exact" : ""); },
     optional, kinds::guarantee},
    {"judged", [](Line line) { return count(line.candidate.judged); }, always, kinds::whole_number},
    {"wrong_answers", [](Line line) { return count(line.candidate.wrong); }, always, kinds::whole_number},
    {"status", [](Line line) { return line.candidate.status; }, always},
    {"rank", [](Line line) { return line.rank > 0 ? count(line.rank) : ""; }, optional,
     kinds::positive_count},
    {"why_not", [](Line line) { return why_not(line.candidate, line.asked.limits); }, optional},
    {"margin_usual", of_margin<margin_usual>, optional, kinds::positive},
    {"margin_worst", of_margin<margin_worst>, optional, kinds::positive},
    {"warm_ns_p999", of_times<&QueryTimes::warm_p999>, optional, kinds::positive},
    {"warm_ns_max", of_times<&QueryTimes::warm_max>, optional, kinds::positive},
    {"cold_ns_p50", of_times<&QueryTimes::cold_p50>, optional, kinds::positive},
    {"cold_ns_p99", of_times<&QueryTimes::cold_p99>, optional, kinds::positive},
    {"cold_ns_max", of_times<&QueryTimes::cold_max>, optional, kinds::positive},
    {"cold_samples",
     [](Line line) { return line.candidate.times ? count(line.candidate.times->cold_samples) : ""; },
     optional, kinds::positive_count},
    {"slowest_motion",
     [](Line line) { return line.candidate.times ? line.candidate.times->motion : std::string(); }, optional},
    {"build_ms", [](Line line) { return line.candidate.build_ms ? rounded(*line.candidate.build_ms) : ""; },
     optional, kinds::finite},
    {"bytes", [](Line line) { return line.candidate.bytes ? count(*line.candidate.bytes) : ""; }, optional,
     kinds::whole_number},
});

}  // namespace

std::span<const results::Column<ChooseLine>> choose_columns() { return columns; }

std::string choose_csv(const std::string& run_id, const Asked& asked,
                       const std::vector<Candidate>& candidates) {
  std::vector<std::size_t> ranks(candidates.size());
  std::size_t rank = 0;
  for (const std::size_t i : ranking(candidates, asked.limits)) ranks[i] = ++rank;
  support::Table table(results::names_of(columns));
  for (std::size_t i = 0; i < candidates.size(); ++i)
    table.add(results::fields_of(columns, ChooseLine{asked, candidates[i], ranks[i]}, run_id));
  return table.csv();
}

}  // namespace touchmark::bench::experiments::choose
