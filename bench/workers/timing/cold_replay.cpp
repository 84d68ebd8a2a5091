#include "bench/workers/timing/cold_replay.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bench/workers/timing/update_timing.h"
#include "bench/workload/sample_steps.h"

namespace touchmark::bench::workers {

ColdReplay::ColdReplay(const std::vector<workload::StepRange>& ranges, std::size_t first_sample,
                       EvictionBuffer* eviction, std::span<TickRecord> records) noexcept
    : ranges_(ranges), steps_(workload::steps_in(ranges)), eviction_(eviction), records_(records) {
  assert(steps_ > 0);
  run_ = run_from(first_sample);
  led_up_to_ = run_.begin - std::min(run_.begin, lead_up);
}

/// Returns as many steps of one range as there are samples, or all that it has.
workload::StepRange ColdReplay::run_from(std::size_t first_sample) const noexcept {
  constexpr double golden_ratio = 1.618033988749895;
  const std::size_t runs_before = records_.empty() ? 0 : first_sample / records_.size();
  const double turns = (static_cast<double>(runs_before) + 0.5) * golden_ratio;
  auto step = static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(steps_));
  for (const workload::StepRange& range : ranges_) {
    if (step < range.size()) {
      const std::size_t size = std::min(range.size(), records_.size());
      const std::size_t begin = range.begin + std::min(step, range.size() - size);
      return {begin, begin + size};
    }
    step -= range.size();
  }
  return {ranges_.back().end - 1, ranges_.back().end};
}

std::optional<std::size_t> ColdReplay::next() noexcept {
  if (sample_ == records_.size()) return std::nullopt;
  if (led_up_to_ < run_.begin) return led_up_to_;
  if (eviction_ != nullptr) walked_ += eviction_->walk();
  return step_of_sample();
}

void ColdReplay::took(std::uint64_t ticks, const workload::Answer& answer, const Work& work) noexcept {
  if (led_up_to_ < run_.begin) {
    ++led_up_to_;
    return;
  }
  workload::Checksum checksum;
  checksum.add(answer);
  records_[sample_] = {1, static_cast<std::uint32_t>(step_of_sample()), 0, ticks, checksum.value(), work};
  ++sample_;
}

ColdSamples run_cold(contestants::Contestant& contestant, const workload::QueryTrace& trace,
                     const std::vector<workload::StepRange>& ranges, const request::Cold& request,
                     const OutputBuffers& buffers, std::span<const std::byte> memory) {
  constexpr std::size_t between_looks = 5;  // samples without a look at the time
  const Clock::time_point start = Clock::now();
  std::span<TickRecord> records = buffers.tick_records(request.floor_samples + request.max_samples);
  std::ranges::fill(records, TickRecord{});  // no page fault in a clocked query
  assert(request.evicted_bytes <= memory.size());
  EvictionBuffer buffer(memory.first(request.evicted_bytes));
  EvictionBuffer* const eviction = request.evicted_bytes > 0 ? &buffer : nullptr;
  ColdReplay floor(ranges, 0, eviction, records.first(request.floor_samples));
  run_idle(floor);
  records = records.subspan(request.floor_samples);
  std::size_t taken = 0;
  while (taken < request.min_samples ||
         (taken < request.max_samples && ns_since(start) < request.budget_ns)) {
    const std::size_t some = std::min(between_looks, request.max_samples - taken);
    ColdReplay replay(ranges, request.first_sample + taken, eviction, records.subspan(taken, some));
    contestant.replay_paced(trace, replay);
    taken += some;
  }
  return {taken};
}

}  // namespace touchmark::bench::workers
