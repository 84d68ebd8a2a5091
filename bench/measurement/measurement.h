/// One contestant on one trajectory, from the first answer to the finished row.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/ground_truth/ground_truth.h"
#include "bench/measurement/effort.h"
#include "bench/measurement/piece_times.h"
#include "bench/measurement/result_row.h"
#include "bench/measurement/verified_passes.h"
#include "bench/workers/contestant_process.h"
#include "bench/workload/sample_plan.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::measurement {

/// Steps in the order of their declaration; each of the measuring ones may come several times, other
/// contestants' in between. Whatever the worker does, the measurement goes on with its status; only
/// ResourceError and Interrupted are thrown.
class Measurement {
 public:
  /// All references must outlive it.
  Measurement(const workload::Workload& workload, const workers::SharedArena& arena, const Effort& effort,
              workers::ContestantProcess& process, std::size_t trace, workload::Query query,
              const workload::SamplePlan& plan);

  std::string contestant() const { return row_.contestant(); }
  /// False once something went wrong, or for a query that the contestant does not answer.
  bool alive() const noexcept { return row_.status == "ok"; }

  /// Builds if that was not done, asks the first question, finds how many steps there is time for.
  void calibrate();
  /// Calibrates it with the steps and repetitions of another contestant's measurement.
  void calibrate_like(const Measurement& other);
  /// Has the steps answered and judged, before anything is timed; once more by `rounded`, unless that is
  /// null: the ground truth of the mesh as the contestant's library stores it.
  void verify(ground_truth::TraceTruths& truths, ground_truth::TraceTruths* rounded = nullptr);

  /// Times a pass with a fresh session, after others used the caches. A detector that builds lazily is built
  /// anew just before, so that this work is in the time.
  void first_pass();
  void repetition();
  void latency_pass();
  /// Some of the samples with emptied caches.
  void cold_pass();

  /// Counts the cache lines of some queries, where that is asked for: valgrind does, and nothing is timed.
  void count_lines();

  /// Ends the contestant's process, which takes its memory. Asked again, it would be built again.
  void shut_down();
  ResultRow row();

  bool claims_exactness() const noexcept {
    return row_.accuracy && row_.accuracy->guarantee == Guarantee::exact;
  }
  /// A query's, as found before anything was verified: for choosing, not for telling.
  double calibrated_ns() const noexcept { return calibrated_ns_; }
  const contestants::ContestantSpec& spec() const noexcept { return process_.spec(); }

 private:
  /// A worker that fails gives the row its status.
  template <class Action>
  void attempt(Action action) {
    if (!alive()) return;
    try {
      action();
    } catch (const workers::WorkerFailure& failure) {
      row_.status = failure.what();
    }
  }
  void begin();
  void choose_steps();
  void choose_pieces();
  PieceTimes piece_times() const;
  /// Few samples are taken with emptied caches, so of the same steps whoever is asked, but the slowest.
  workers::Task cold_task() const {
    constexpr std::size_t common_steps = 512;
    workers::Task task = task_;
    task.ranges = plan_.ranges(std::min(row_.steps, common_steps));
    return task;
  }
  void take_cold_samples(std::size_t bytes, std::size_t max_samples, double budget_ns,
                         std::vector<double>& ns, std::vector<double>& floor_ns);
  std::vector<double> in_ns(std::span<const std::uint64_t> ticks) const;
  void expect_verified_answers(const workers::Timed& timed);
  void judge(ground_truth::TraceTruths& truths, ground_truth::TraceTruths* rounded);
  void judge_second_pass(ground_truth::TraceTruths& truths);

  const workers::SharedArena& arena_;
  const Effort& effort_;
  workers::ContestantProcess& process_;
  double busy_before_s_;  ///< the process may have served other measurements
  ResultRow row_;
  workers::Task task_;
  const workload::SamplePlan& plan_;
  std::vector<workload::StepRange> ranges_;  // those of the task, neighbours joined
  double calibrated_ns_ = 0;
  VerifiedPasses verified_;
  std::int64_t passes_ = 1;   // a repetition's
  std::int64_t replays_ = 1;  // passes a sample
  double first_pass_ns_ = 0;
  double repeating_ns_ = 0;                   // spent on repetitions
  std::vector<std::vector<double>> samples_;  // a repetition's each
  std::size_t interrupted_ = 0;
  std::vector<double> repetitions_ns_;
  std::vector<double> repetitions_cpu_ns_;
  std::vector<std::vector<double>> latencies_ns_;
  std::vector<std::vector<double>> prepared_ns_;
  std::vector<double> cold_l2_ns_, cold_ns_, floor_l2_ns_, floor_ns_;
  std::shared_ptr<StepLog> log_;
  std::vector<workload::Checksum>
      answer_checksums_;  // of the verified answers, where caches are to be emptied
};

}  // namespace touchmark::bench::measurement
