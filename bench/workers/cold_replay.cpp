#include "bench/workers/cold_replay.h"

#include <algorithm>
#include <cassert>

#include <unistd.h>

#include "bench/support/available_memory.h"
#include "bench/workload/sample_steps.h"

namespace touchmark::bench::workers {
namespace {

constexpr std::size_t words_a_line = 64 / sizeof(std::uint64_t);

}  // namespace

EvictionBuffer::EvictionBuffer(std::size_t bytes) : words_(bytes / sizeof(std::uint64_t), 1) {}

std::uint64_t EvictionBuffer::walk() noexcept {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < words_.size(); i += words_a_line) sum += words_[i];
  return sum;
}

EvictionSizes eviction_sizes(std::size_t second_level_cache, std::size_t last_level_cache, std::size_t most) {
  constexpr std::size_t megabyte = 1U << 20U;
  const std::size_t second = second_level_cache > 0 ? second_level_cache : megabyte;
  const std::size_t last = last_level_cache > 0 ? last_level_cache : 32 * megabyte;
  return {std::min(2 * second, most), std::min(2 * std::max(last, second), most)};
}

EvictionSizes eviction_sizes() {
  const auto size_of = [](int name) { return static_cast<std::size_t>(std::max(sysconf(name), 0L)); };
  const auto available = support::available_memory();
  return eviction_sizes(size_of(_SC_LEVEL2_CACHE_SIZE), size_of(_SC_LEVEL3_CACHE_SIZE),
                        available ? static_cast<std::size_t>(*available / 8) : std::size_t{1} << 30U);
}

ColdReplay::ColdReplay(const std::vector<workload::StepRange>& ranges, const request::Cold& request,
                       EvictionBuffer* eviction, std::span<TickRecord> records) noexcept
    : ranges_(ranges),
      steps_(workload::steps_in(ranges)),
      first_(request.first_sample),
      of_(std::max(request.samples_in_all, request.first_sample + request.samples)),
      eviction_(eviction),
      records_(records) {
  assert(steps_ > 0);
}

/// The middle of its share of the steps.
std::size_t ColdReplay::step_of_sample() const noexcept {
  std::size_t step = static_cast<std::size_t>((2 * (first_ + sample_) + 1) * steps_ / (2 * of_));
  for (const workload::StepRange& range : ranges_) {
    if (step < range.size()) return range.begin + step;
    step -= range.size();
  }
  return ranges_.back().end - 1;
}

std::optional<std::size_t> ColdReplay::next() noexcept {
  if (sample_ == records_.size()) return std::nullopt;
  const std::size_t step = step_of_sample();
  if (!led_up_ && step > 0) return step - 1;
  led_up_ = true;
  if (eviction_ != nullptr) walked_ += eviction_->walk();
  return step;
}

void ColdReplay::took(std::uint64_t ticks, const workload::Answer& answer, const Work& work) noexcept {
  if (!led_up_) {
    led_up_ = true;
    return;
  }
  workload::Checksum checksum;
  checksum.add(answer);
  records_[sample_] = {1, static_cast<std::uint32_t>(step_of_sample()), 0, ticks, checksum.value(), work};
  ++sample_;
  led_up_ = false;
}

void run_cold(contestants::Contestant& contestant, const workload::QueryTrace& trace,
              const std::vector<workload::StepRange>& ranges, const request::Cold& request,
              const OutputBuffers& buffers) {
  const std::span<TickRecord> records = buffers.tick_records(request.samples);
  std::fill(records.begin(), records.end(), TickRecord{});  // no page fault in a clocked query
  EvictionBuffer eviction(request.evicted_bytes);
  ColdReplay replay(ranges, request, request.evicted_bytes > 0 ? &eviction : nullptr, records);
  if (request.idle) return run_idle(replay);
  contestant.replay_paced(trace, replay);
}

}  // namespace touchmark::bench::workers
