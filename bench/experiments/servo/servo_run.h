/// The paced loop of every contestant, in stretches that take turns with the same loop idle.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/contestants/roster.h"
#include "bench/experiments/servo/proxy_replay.h"
#include "bench/experiments/servo/servo_row.h"
#include "bench/ground_truth/ground_truth.h"
#include "bench/proxies/way_oracle.h"
#include "bench/workers/contestant_process.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::experiments::servo {

/// Returns how many ticks a stretch has: a tenth of a second of them, but at least 16, or the whole run.
std::uint64_t ticks_a_stretch(const ServoSettings& settings);

class ServoRun {
 public:
  /// One trajectory. `roster` and `workload` must outlive it.
  ServoRun(const contestants::Roster& roster, const workload::Workload& workload, workload::Query query,
           const std::vector<contestants::ContestantSpec>& contestants, const ServoSettings& settings,
           const workers::WorkerOptions& workers);

  /// Builds all of them, and has the oracle judge their answers to every step; the ways of proxies are judged
  /// once they are gone. Whatever a worker does is its row's status; only ResourceError and Interrupted are
  /// thrown.
  void verify(const std::function<void(const std::string& contestant)>& progress);
  /// Runs the loops. After Interrupted the rows hold what was finished.
  void run(const std::function<void(std::uint64_t ticks)>& progress);

  const std::vector<ServoRow>& rows() const noexcept { return rows_; }
  std::vector<ServoRow>& rows() noexcept { return rows_; }
  const std::deque<workers::ContestantProcess>& contestants() const noexcept { return processes_; }

 private:
  void verify(std::size_t contestant, ground_truth::TraceTruths& truths);
  void begin_proxies(const std::function<void(const std::string& contestant)>& progress);
  /// Has the oracle judge the ticks of a stretch.
  void judge_proxy(std::size_t contestant, const workers::ServoStretch& stretch, std::size_t warm_up);
  /// Compares the answers of a stretch with the verified ones.
  void compare_answers(std::size_t contestant, std::span<const workers::TickRecord> records);
  /// Runs one stretch of every contestant and of its idle loop, in the order of `turns`.
  void take_turns(const std::vector<std::pair<std::size_t, bool>>& turns, std::uint64_t ticks);
  void find_cause_of_overrun(std::size_t contestant, std::uint64_t ticks);
  void run_stretch(std::size_t contestant, bool idle, std::uint64_t ticks);
  /// Notes a worker's failure as the row's status.
  template <class Action>
  void attempt(std::size_t contestant, Action action);
  workers::Task task() const { return {0, query_, workload_.traces.front().size()}; }

  const workload::Workload& workload_;
  const contestants::Roster& roster_;
  workload::Query query_;
  ServoSettings settings_;
  workers::SharedArena arena_;
  std::deque<workers::ContestantProcess> processes_;
  std::vector<ServoRow> rows_;
  std::vector<std::vector<std::uint64_t>> checksums_;  // of each contestant's verified answers, by step
  std::vector<std::uint64_t> next_tick_;               // where on the trajectory each contestant is
  Vec3 start_ = Vec3::Zero();                          // where proxies begin
  std::vector<std::unique_ptr<ProxyReplay>> replays_;
};

}  // namespace touchmark::bench::experiments::servo
