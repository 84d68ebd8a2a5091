/// Measures one batch of the gate: detector, reference and control, each in a process of its own, turn by
/// turn in random order on one core, in processor time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "bench/contestants/roster.h"
#include "bench/ground_truth/workload_truths.h"
#include "bench/measurement/result_row.h"
#include "bench/regression/gate/judge.h"
#include "bench/workers/contestant_process.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::regression::gate {

/// A detector, or the reference, that did not answer as it should: crashed, refused the mesh, violated its
/// guarantee, or answered otherwise when it was timed. what() says who and how.
class GateFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct GateEffort {
  std::size_t rounds = 31;    ///< one turn each
  double turn_ns = 8e6;       ///< a turn replays the steps until it has lasted so long
  double max_pass_ns = 20e6;  ///< a replay of the steps may take so long where the gate chooses how many
};

struct GatePair {
  contestants::ContestantSpec detector;
  contestants::ContestantSpec reference;
  std::size_t trace = 0;
  workload::Query query = workload::Query::nearest;
};

/// What the detector answered, checked against the oracle.
struct GateAnswers {
  std::uint64_t checksum = 0;
  measurement::WorkResult work;
};

class PairedBatches {
 public:
  /// All references must outlive it. `steps` 0: as many as both have time for.
  PairedBatches(const contestants::Roster& roster, const workload::Workload& workload,
                const workers::SharedArena& arena, ground_truth::WorkloadTruths& truths, GatePair pair,
                const GateEffort& effort, std::size_t steps, std::uint64_t seed);

  /// Starts the three processes anew, so that chance in how memory was laid out is drawn anew, too. Throws
  /// GateFailure, ResourceError or Interrupted.
  Batch measure();

  /// Replayed of the trace; known after the first batch.
  std::size_t steps() const noexcept { return steps_; }
  /// The detector's, after the first batch.
  const GateAnswers& answers() const noexcept { return *answers_; }
  /// Answers judged in all batches, of the detector, the reference and its control.
  std::uint64_t judged() const noexcept { return judged_; }
  /// Returns the last batch's ratios, one a round: detector over reference.
  const std::vector<double>& log_ratios() const noexcept { return log_ratios_; }

 private:
  class Contender;
  void choose_steps(Contender& detector, Contender& reference);

  const contestants::Roster& roster_;
  const workload::Workload& workload_;
  const workers::SharedArena& arena_;
  ground_truth::WorkloadTruths& truths_;
  GatePair pair_;
  GateEffort effort_;
  std::size_t steps_;
  std::uint64_t seed_;
  std::optional<GateAnswers> answers_;
  std::vector<double> log_ratios_;  // of the last batch
  std::uint64_t judged_ = 0;
};

}  // namespace touchmark::bench::regression::gate
