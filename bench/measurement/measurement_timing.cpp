// The passes of a measurement that are timed: warm, clocked step by step, and with emptied caches.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bench/measurement/measurement.h"
#include "bench/workers/timing/eviction.h"
#include "bench/workload/sample_steps.h"

namespace touchmark::bench::measurement {

namespace request = workers::request;

void Measurement::expect_verified_answers(const workers::Timed& timed) {
  if (!verified_.hold(timed)) row_.status = "checksum mismatch";
}

void Measurement::first_pass() {
  attempt([&] {
    process_.rebuild_if_lazy();
    const workers::Timed timed = process_.ask(request::FirstPass{task_});
    first_pass_ns_ = timed.ns_per_query;
    expect_verified_answers(timed);
  });
}

/// Whoever needs longer for a single pass than there is time for is repeated less often.
void Measurement::repetition() {
  constexpr std::size_t fewest = 3;
  const double budget =
      static_cast<double>(effort_.repetitions) * std::max(2 * effort_.pass_budget_ns, effort_.repetition_ns);
  if (repetitions_ns_.size() >= fewest && repeating_ns_ > budget) return;
  attempt([&] {
    const workers::Timed timed = process_.ask(request::Sample{task_, passes_, replays_});
    repetitions_ns_.push_back(timed.ns_per_query);
    repetitions_cpu_ns_.push_back(timed.cpu_ns_per_query);
    repeating_ns_ +=
        timed.cpu_ns_per_query * static_cast<double>(row_.steps) * static_cast<double>(passes_ * replays_);
    samples_.push_back(timed.samples);
    interrupted_ += timed.interrupted;
    expect_verified_answers(timed);
  });
}

void Measurement::latency_pass() {
  attempt([&] {
    const workers::Timed timed = process_.ask(request::Latency{task_});
    expect_verified_answers(timed);
    latencies_ns_.push_back(in_ns(arena_.buffers().ticks(row_.steps)));
    if (process_.build().prepares) prepared_ns_.push_back(in_ns(arena_.buffers().prepare_ticks(row_.steps)));
  });
}

void Measurement::take_cold_samples(std::size_t bytes, std::size_t max_samples, double budget_ns,
                                    std::vector<double>& ns, std::vector<double>& floor_ns) {
  if (max_samples == 0) return;
  request::Cold request{
      cold_task(), bytes,    cold_floor_samples, ns.size(), std::min(effort_.min_cold_samples, max_samples),
      max_samples, budget_ns};
  const std::size_t taken = process_.ask(request).taken;
  const double ns_per_tick = process_.opened().ns_per_tick;
  const std::span<const workers::TickRecord> records =
      arena_.buffers().tick_records(cold_floor_samples + taken);
  for (const workers::TickRecord& record : records.first(cold_floor_samples))
    floor_ns.push_back(static_cast<double>(record.query_ticks) * ns_per_tick);
  for (const workers::TickRecord& record : records.subspan(cold_floor_samples)) {
    ns.push_back(static_cast<double>(record.query_ticks) * ns_per_tick);
    // Whoever names any of several nearest triangles may name another one after other steps.
    if (row_.accuracy->names_exactly &&
        record.checksum != answer_checksums_[workload::place_in(ranges_, record.step)].value())
      row_.status = "checksum mismatch";
  }
}

void Measurement::cold_pass() {
  const workers::EvictionSizes sizes = workers::eviction_sizes();
  constexpr double share_of_l2 = 0.25;  // of the time
  const double budget = effort_.cold_budget_ns / static_cast<double>(effort_.cold_passes);
  attempt([&] {
    take_cold_samples(sizes.second_level, effort_.of_cold_pass(effort_.cold_l2_samples), share_of_l2 * budget,
                      cold_l2_ns_, floor_l2_ns_);
    take_cold_samples(sizes.all, effort_.of_cold_pass(effort_.cold_samples), (1 - share_of_l2) * budget,
                      cold_ns_, floor_ns_);
  });
}

void Measurement::count_lines() {
  if (effort_.line_samples == 0 || !alive()) return;
  try {
    row_.lines = process_.count_cache_lines(task_, effort_.line_samples);
  } catch (const workers::WorkerFailure&) {
    // Who cannot run under valgrind has no counts; what was timed stands.
  }
}

std::vector<double> Measurement::in_ns(std::span<const std::uint64_t> ticks) const {
  std::vector<double> ns;
  ns.reserve(ticks.size());
  for (const std::uint64_t step : ticks)
    ns.push_back(static_cast<double>(step) * process_.opened().ns_per_tick);
  return ns;
}

}  // namespace touchmark::bench::measurement
