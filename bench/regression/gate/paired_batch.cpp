#include "bench/regression/gate/paired_batch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "bench/ground_truth/ground_truth.h"
#include "bench/measurement/verified_passes.h"
#include "bench/support/interleaving.h"
#include "bench/support/random.h"
#include "bench/support/system/interrupt.h"
#include "bench/workload/sample_steps.h"

namespace touchmark::bench::regression::gate {

/// One of the three, with the times of its turns.
class PairedBatches::Contender {
 public:
  Contender(const PairedBatches& batches, const contestants::ContestantSpec& spec)
      : batches_(batches),
        process_(batches.arena_, spec, batches.roster_.find(spec.name).worker_program(spec.values)),
        task_{batches.pair_.trace, batches.pair_.query, 1} {}

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw GateFailure(fmt::format("{} on {}: {}", process_.spec().text(),
                                  batches_.workload_.trajectories[task_.trace], what));
  }

  template <class Action>
  auto attempt(Action action) {
    try {
      return action();
    } catch (const workers::WorkerFailure& failure) {
      fail(failure.what());
    }
  }

 public:
  void build() {
    const workers::Built& built = attempt([&] { return process_.build(); });
    if (std::ranges::find(built.queries, task_.query) == built.queries.end())
      fail("does not answer this query");
    accuracy_ = built.accuracy;
  }

  double ns_per_query(double budget_ns) {
    return std::max(attempt([&] {
                      return process_.ask(workers::request::Calibrate{task_, budget_ns});
                    }).ns_per_query,
                    1.0);
  }

  /// Before anything is timed.
  GateAnswers answer(std::size_t steps, ground_truth::TraceTruths& truths) {
    task_.steps = steps;
    const std::vector<workload::StepRange> ranges =
        workload::sample_steps(batches_.workload_.traces[task_.trace].size(), steps);
    const workers::Answered answered = attempt([&] { return process_.ask(workers::request::Answer{task_}); });
    const workers::OutputBuffers& buffers = batches_.arena_.buffers();
    const std::size_t count = workload::steps_in(ranges);
    const oracle::ErrorCounts counts = truths.judge(task_.query, ranges, buffers.answers(count), accuracy_);
    judged_ += counts.judged;
    if (!oracle::meets_guarantee(counts, accuracy_))
      fail("gives wrong answers (touchmark verify says which)");
    const GateAnswers answers{answered.checksum,
                              measurement::summarize_work(buffers.work(count), answered.work)};
    verified_ = attempt([&] {
      return measurement::verified_passes(process_, task_, answered.checksum, accuracy_, [&] {
        return oracle::meets_guarantee(truths.judge(task_.query, ranges, buffers.answers(count), accuracy_),
                                       accuracy_);
      });
    });
    return answers;
  }

  /// One turn that is not counted tells how many passes a turn has.
  void warm_up(double turn_ns) {
    const double pass_ns = timed(1) * static_cast<double>(task_.steps);
    passes_ = static_cast<std::int64_t>(std::clamp(turn_ns / std::max(pass_ns, 1.0), 1.0, 1e6));
  }

  void turn() { log_ns_.push_back(std::log(std::max(timed(passes_), 1e-3))); }
  const std::vector<double>& log_ns() const noexcept { return log_ns_; }
  std::uint64_t judged() const noexcept { return judged_; }

 private:
  double timed(std::int64_t passes) {
    const workers::Timed timed = attempt([&] { return process_.ask(workers::request::Time{task_, passes}); });
    if (!verified_.hold(timed)) fail("answers otherwise when it is timed");
    return timed.cpu_ns_per_query;
  }

  const PairedBatches& batches_;
  workers::ContestantProcess process_;
  workers::Task task_;
  Accuracy accuracy_;
  measurement::VerifiedPasses verified_;
  std::uint64_t judged_ = 0;
  std::int64_t passes_ = 1;
  std::vector<double> log_ns_;
};

namespace {

std::vector<double> differences(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  std::transform(a.begin(), a.end(), b.begin(), result.begin(), std::minus<>());
  return result;
}

}  // namespace

PairedBatches::PairedBatches(const contestants::Roster& roster, const workload::Workload& workload,
                             const workers::SharedArena& arena, ground_truth::WorkloadTruths& truths,
                             GatePair pair, const GateEffort& effort, std::size_t steps, std::uint64_t seed)
    : roster_(roster),
      workload_(workload),
      arena_(arena),
      truths_(truths),
      pair_(std::move(pair)),
      effort_(effort),
      steps_(steps),
      seed_(seed) {}

void PairedBatches::choose_steps(Contender& detector, Contender& reference) {
  const double budget = effort_.max_pass_ns;
  const double slower = std::max(detector.ns_per_query(budget), reference.ns_per_query(budget));
  const std::size_t all = workload_.traces[pair_.trace].size();
  const double wanted = std::clamp(budget / slower, 1.0, static_cast<double>(all));
  steps_ = workload::steps_in(workload::sample_steps(all, static_cast<std::size_t>(wanted)));
}

Batch PairedBatches::measure() {
  std::array<Contender, 3> contenders{Contender(*this, pair_.detector), Contender(*this, pair_.reference),
                                      Contender(*this, pair_.reference)};
  for (Contender& contender : contenders) contender.build();
  auto& [detector, reference, control] = contenders;
  if (steps_ == 0) choose_steps(detector, reference);
  const std::unique_ptr<ground_truth::TraceTruths> truths = truths_.of(pair_.trace);
  answers_ = detector.answer(steps_, *truths);
  reference.answer(steps_, *truths);
  control.answer(steps_, *truths);
  for (const Contender& contender : contenders) judged_ += contender.judged();
  for (Contender& contender : contenders) contender.warm_up(effort_.turn_ns);

  support::Random random(seed_++);
  const std::vector<std::size_t> rounds(effort_.rounds, contenders.size());
  for (const support::Turn& turn : support::interleaved(rounds, random)) {
    support::check_for_interrupt();
    contenders[turn.which].turn();
  }
  log_ratios_ = differences(detector.log_ns(), reference.log_ns());
  return {median_ratio(log_ratios_, seed_),
          median_ratio(differences(control.log_ns(), reference.log_ns()), seed_)};
}

}  // namespace touchmark::bench::regression::gate
