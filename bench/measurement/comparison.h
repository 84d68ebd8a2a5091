/// The comparison: every contestant on every trajectory of one workload, verified and then, if wanted, timed
/// in random order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/contestants/roster.h"
#include "bench/ground_truth/ground_truth.h"
#include "bench/ground_truth/rounded_mesh.h"
#include "bench/ground_truth/workload_truths.h"
#include "bench/measurement/effort.h"
#include "bench/measurement/result_row.h"
#include "bench/measurement/steadiness.h"
#include "bench/workers/contestant_process.h"
#include "bench/workload/sample_plan.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::measurement {

/// Called before each request to a worker.
using Progress = std::function<void(const std::string& trajectory, const std::string& contestant)>;

/// Which measurements are wanted, by trajectory and contestant.
using CaseFilter = std::function<bool(const std::string& trajectory, const std::string& contestant)>;

/// interleaved: all contestants are built before any is timed, and then timed in random order. sequential:
/// each is built, verified, timed and ended before the next, where memory does not hold all of them.
enum class Schedule { interleaved, sequential };

class Comparison {
 public:
  /// `roster` and `workload` must outlive it. A contestant that cannot run becomes a row, not an error.
  Comparison(const contestants::Roster& roster, const workload::Workload& workload,
             const std::vector<contestants::ContestantSpec>& contestants,
             const workers::WorkerOptions& workers, const Effort& effort, std::uint64_t seed);
  ~Comparison();

  void set_progress(Progress progress) { progress_ = std::move(progress); }
  void set_filter(CaseFilter filter) { filter_ = std::move(filter); }
  void set_schedule(Schedule schedule) { schedule_ = schedule; }
  /// For the runs that follow; none may be begun and not ended.
  void set_effort(const Effort& effort) { effort_ = effort; }
  /// Its rows get this status instead of results.
  void skip(const contestants::ContestantSpec& spec, const std::string& status);

  /// The rows of one trajectory, in the contestants' order. Throws ResourceError or Interrupted.
  std::vector<ResultRow> run(std::size_t trace, workload::Query query);

  /// Runs a trajectory in two parts, between which others may be begun: a machine that is slow for some
  /// seconds is then slow for a part of each trajectory's rounds, not for all of one's. end() is of the first
  /// that was begun.
  void begin(std::size_t trace, workload::Query query);
  std::vector<ResultRow> end();
  /// The rows of those that were begun and not ended, with the repetitions that they have got, if any.
  std::vector<ResultRow> so_far();

  /// All of them, appended to `rows` trace by trace, so that those finished before an exception are there.
  /// What the oracle finds out about a trace serves all queries.
  void run_all(const std::vector<workload::Query>& queries, std::vector<ResultRow>& rows);

  /// Returns how steady each trace and query was that was timed, in the order of the runs.
  const std::vector<Steadiness>& steadiness() const noexcept { return steadiness_; }

  /// Returns what is true at each step of a trace that was begun, where the effort asks for logs.
  const std::vector<ground_truth::StepTruth>& truths(std::size_t trace) const { return truths_[trace]; }

  /// Returns what the filter left out: pairs of trajectory and contestant.
  const std::vector<std::pair<std::string, std::string>>& left_out() const noexcept { return left_out_; }

  /// Returns the contestants with what their workers said of themselves.
  const std::deque<workers::ContestantProcess>& contestants() const noexcept { return processes_; }

 private:
  struct Begun;

  std::unique_ptr<ground_truth::TraceTruths> truths_of(std::size_t trace);
  std::vector<ResultRow> run(std::size_t trace, workload::Query query, ground_truth::TraceTruths& truths);
  void begin(std::size_t trace, workload::Query query, ground_truth::TraceTruths& truths);
  void verify(Begun& begun, ground_truth::TraceTruths& truths);
  void add_control(Begun& begun, ground_truth::TraceTruths& truths);
  std::vector<ResultRow> rows_of(Begun& begun);
  /// The mesh as that process's library rounds it, made when first asked for; null where it is the given
  /// one.
  const ground_truth::RoundedMesh* rounded_mesh_of(std::size_t process);
  void verify(class Measurement& one, const ground_truth::RoundedMesh* rounded, std::size_t trace,
              ground_truth::TraceTruths& truths);
  /// Takes the requests of `begun` up to this one.
  void measure(Begun& begun, std::size_t end);
  workload::SamplePlan plan_for(std::size_t trace, ground_truth::TraceTruths& truths) const;
  /// The process that times a contestant once more: that of the trace before, where its contestant still is
  /// among the right ones, or else the fastest one's. Null where there is none.
  class Measurement* to_control(const std::vector<class Measurement*>& measurements);

  const contestants::Roster& roster_;
  const workload::Workload& workload_;
  Effort effort_;
  std::uint64_t seed_;
  Schedule schedule_ = Schedule::interleaved;
  workers::SharedArena arena_;
  ground_truth::WorkloadTruths workload_truths_;
  std::deque<workers::ContestantProcess> processes_;
  std::vector<std::optional<std::unique_ptr<const ground_truth::RoundedMesh>>>
      rounded_meshes_;  ///< a process each
  std::optional<workers::ContestantProcess> control_;
  std::deque<std::unique_ptr<Begun>> begun_;
  std::vector<std::vector<ground_truth::StepTruth>> truths_;  ///< one list a trace
  std::vector<Steadiness> steadiness_;
  std::vector<std::pair<std::string, std::string>> left_out_;
  Progress progress_ = [](const std::string&, const std::string&) {};
  CaseFilter filter_ = [](const std::string&, const std::string&) { return true; };
};

}  // namespace touchmark::bench::measurement
