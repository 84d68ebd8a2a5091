#include "bench/experiments/stress/stress_run.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bench/measurement/comparison.h"
#include "bench/results/verification_report.h"
#include "bench/support/failures.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::stress {
namespace {

constexpr std::size_t probes_a_round = 20'000;
constexpr std::size_t faults_kept = 1000;
/// Slow contestants are to answer everything too.
constexpr double pass_budget_ns = 2e9;
/// One repetition, to see that the same questions get the same answers again, and how fast; in a family's
/// first round, as further ones only ask more.
constexpr measurement::Effort first_effort{1, 0, pass_budget_ns, 0}, further_effort{0, 0, pass_budget_ns, 0};

/// To be followed by the step's number; see --repeat of `touchmark stress`.
std::string repeat_command(const Family& family, std::uint64_t seed, std::size_t probes,
                           std::size_t workload_index, const workload::Workload& workload,
                           const measurement::ResultRow& row) {
  const auto trace = std::ranges::find(workload.trajectories, row.trajectory);
  return fmt::format("touchmark stress --family {} --seed {} --probes {} {} --repeat {}/{}/{}/", family.name,
                     seed, probes, row.as_typed(), name_of(row.query), workload_index,
                     trace - workload.trajectories.begin());
}

}  // namespace

StressRun::StressRun(const contestants::Roster& roster, StressRequest request)
    : roster_(roster), request_(std::move(request)), flushed_to_zero_(request_.contestants.size()) {}

FamilyCount StressRun::count_of(const Family& family) const {
  const auto count = counts_.find(&family);
  return count != counts_.end() ? count->second : FamilyCount{};
}

void StressRun::run(const Progress& progress) {
  // All families in each round, so that a campaign that is ended has something of every one.
  std::size_t left = request_.probes;
  for (std::uint64_t round = 0; left > 0; ++round) {
    const std::size_t some = std::min(left, probes_a_round);
    for (const Family* family : request_.families) run_round(*family, request_.seed + round, some, progress);
    left -= some;
  }
}

void StressRun::run_round(const Family& family, std::uint64_t seed, std::size_t probes,
                          const Progress& progress) {
  progress(fmt::format("{}: asking the oracle", family.name));
  std::vector<workload::Workload> workloads;
  try {
    workloads = family.make(seed, probes);
  } catch (const MeshError& error) {
    refuse_all(family, error.what());
    return;
  }
  ++counts_[&family].rounds;
  for (std::size_t workload_index = 0; workload_index < workloads.size(); ++workload_index)
    if (!workloads[workload_index].traces.empty())
      run_workload(family, seed, probes, workload_index, workloads[workload_index], progress);
}

void StressRun::run_workload(const Family& family, std::uint64_t seed, std::size_t probes,
                             std::size_t workload_index, const workload::Workload& workload,
                             const Progress& progress) {
  const measurement::Effort& effort = counts_[&family].rounds > 1 ? further_effort : first_effort;
  measurement::Comparison comparison(roster_, workload, request_.contestants, request_.workers, effort,
                                     request_.seed);
  comparison.set_progress([&](const std::string& trace, const std::string& contestant) {
    progress(fmt::format("{}, {}, {}: {}", family.name, workload.mesh_name, trace, contestant));
  });
  std::vector<measurement::ResultRow> rows;
  const auto keep = [&] {
    for (measurement::ResultRow& row : rows) {
      row.repeat = repeat_command(family, seed, probes, workload_index, workload, row);
      add(family, row, row.trajectory == workload.trajectories.front());
    }
  };
  try {
    comparison.run_all(request_.queries, rows);
  } catch (const support::Interrupted&) {
    keep();
    throw;
  }
  keep();
  for (const std::vector<workload::Step>& trace : workload.traces) counts_[&family].probes += trace.size();
  for (std::size_t i = 0; i < request_.contestants.size(); ++i)
    if (comparison.contestants()[i].opened().flushed_to_zero) flushed_to_zero_[i] = true;
}

/// There is no mesh to give to any of them.
void StressRun::refuse_all(const Family& family, const std::string& why) {
  for (const contestants::ContestantSpec& spec : request_.contestants) {
    for (const workload::Query query : request_.queries) {
      measurement::ResultRow row;
      row.detector = spec.name;
      row.options = spec.options;
      row.claimed = spec.claimed;
      row.query = query;
      row.status = "refused: " + why;
      add(family, row, true);
    }
  }
}

std::size_t StressRun::place_of(const Score& score) const {
  const auto spec = std::ranges::find_if(request_.contestants, [&](const contestants::ContestantSpec& one) {
    return one.name == score.detector && one.options == score.options;
  });
  return static_cast<std::size_t>(spec - request_.contestants.begin());
}

void StressRun::add(const Family& family, const measurement::ResultRow& row, bool of_another_mesh) {
  auto score = std::ranges::find_if(scores_, [&](const Score& one) { return one.is_of(row, family); });
  if (score == scores_.end()) {
    // Family by family they are found; contestant by contestant they are told.
    const Score first(row, family);
    const auto after =
        std::ranges::find_if(scores_, [&](const Score& other) { return place_of(other) > place_of(first); });
    score = scores_.insert(after, first);
  }
  score->add(row, of_another_mesh);
  if (results::list_of_failures({row}, 1).empty() || faults_.size() == faults_kept) return;
  faults_.push_back(row);
  faults_.back().mesh = fmt::format("{}: {}", family.name, row.mesh);
}

}  // namespace touchmark::bench::experiments::stress
