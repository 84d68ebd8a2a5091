#include "bench/experiments/papers/interleaved_timing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "bench/measurement/latency.h"
#include "bench/support/interleaving.h"
#include "bench/support/median.h"
#include "bench/support/random.h"
#include "bench/support/system/interrupt.h"
#include "bench/support/system/processor_time.h"

namespace touchmark::bench::experiments::papers {
InterleavedTiming::InterleavedTiming(std::span<const workload::Step> steps, workload::Query query,
                                     std::uint64_t seed)
    : trace_{query, steps}, seed_(seed) {}

std::size_t InterleavedTiming::add(std::unique_ptr<contestants::Contestant> contestant) {
  return add(std::move(contestant), trace_.steps);
}

std::size_t InterleavedTiming::add(std::unique_ptr<contestants::Contestant> contestant,
                                   std::span<const workload::Step> steps) {
  support::check_for_interrupt();
  Entry entry{std::move(contestant), {trace_.query, steps}, {}, 0, {}, {}};
  answer_once(entry);
  entries_.push_back(std::move(entry));
  return entries_.size() - 1;
}

void InterleavedTiming::answer_once(Entry& entry) const {
  const std::size_t steps = entry.trace.steps.size();
  std::vector<workload::Answer> answers(steps);
  std::vector<std::uint64_t> work(steps);
  entry.contestant->answer(entry.trace, {0, steps}, answers, work);
  workload::Checksum checksum;
  for (const workload::Answer& answer : answers) {
    checksum.add(answer);
    entry.timed.contacts += answer.found;
  }
  entry.timed.answers = checksum.value();
  entry.timed.work = static_cast<double>(std::accumulate(work.begin(), work.end(), std::uint64_t{0})) /
                     static_cast<double>(steps);
  entry.contestant->forget();
}

void InterleavedTiming::turn(Entry& entry, double min_turn_ns) const {
  const auto replay = [&](std::int64_t passes) {
    workload::Checksum checksum;
    const double start = support::processor_ns();
    for (std::int64_t i = 0; i < passes; ++i)
      entry.contestant->replay(entry.trace, {0, entry.trace.steps.size()}, checksum);
    return std::max(support::processor_ns() - start, 1.0);
  };
  if (entry.passes == 0)
    entry.passes = static_cast<std::int64_t>(std::clamp(std::ceil(min_turn_ns / replay(1)), 1.0, 1e6));
  const double ns = replay(entry.passes);
  entry.turn_ns.push_back(ns / static_cast<double>(entry.passes) /
                          static_cast<double>(entry.trace.steps.size()));
  clock_steps(entry);
}

void InterleavedTiming::clock_steps(Entry& entry) const {
  std::vector<std::uint64_t> ticks(entry.trace.steps.size());
  workload::Checksum checksum;
  entry.contestant->replay_clocked(entry.trace, {0, entry.trace.steps.size()}, checksum, ticks, {});
  std::vector<double> ns;
  ns.reserve(ticks.size());
  for (const std::uint64_t step : ticks) ns.push_back(clock_.ns_of(step));
  entry.step_ns.push_back(std::move(ns));
}

void InterleavedTiming::run(const TimingEffort& effort,
                            const std::function<void(std::size_t, std::size_t)>& progress) {
  support::Random random(seed_);
  const std::vector<std::size_t> rounds(effort.rounds, entries_.size());
  for (const auto& [round, detector] : support::interleaved(rounds, random)) {
    support::check_for_interrupt();
    progress(round, detector);
    turn(entries_[detector], effort.min_turn_ns);
  }
}

TimedTurns InterleavedTiming::timed(std::size_t detector) const {
  TimedTurns timed = entries_[detector].timed;
  const Entry& entry = entries_[detector];
  timed.ns = support::median(entry.turn_ns);
  if (!entry.step_ns.empty()) {
    const double measured = measurement::summarize_latency(measurement::median_per_step(entry.step_ns),
                                                           {{0, entry.trace.steps.size()}})
                                .p99;
    timed.ns_p99 = std::max({measured, clock_.cost_ns, clock_.ns_per_tick});
  }
  return timed;
}

}  // namespace touchmark::bench::experiments::papers
