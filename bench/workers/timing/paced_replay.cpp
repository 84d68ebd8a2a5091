#include "bench/workers/timing/paced_replay.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <ctime>

#include "bench/contestants/tick_clock.h"

namespace touchmark::bench::workers {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;

}  // namespace

std::int64_t MonotonicClock::now_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * second_ns + now.tv_nsec;
}

void MonotonicClock::sleep_until_ns(std::int64_t time) noexcept {
  const timespec until{time / second_ns, time % second_ns};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

std::size_t step_of_tick(std::uint64_t tick, std::size_t steps) noexcept {
  if (steps < 2) return 0;
  const std::uint64_t last = steps - 1, along = tick % (2 * last);
  return static_cast<std::size_t>(along <= last ? along : 2 * last - along);
}

PacedReplay::PacedReplay(const Pace& pace, std::size_t steps, WakeClock& clock, std::span<TickRecord> records,
                         const Accuracy& accuracy, EvictionBuffer* eviction) noexcept
    : pace_(pace),
      steps_(steps),
      clock_(clock),
      records_(records),
      accuracy_(accuracy),
      eviction_(eviction),
      period_ns_(pace.slowdown * 1e9 / pace.rate_hz),
      start_ns_(clock.now_ns()) {
  assert(steps > 0);
}

/// Each from the start, so that rounding does not add up.
std::int64_t PacedReplay::scheduled(std::size_t tick) const noexcept {
  return start_ns_ + std::llround(static_cast<double>(tick + 1) * period_ns_);
}

void PacedReplay::do_other_work() noexcept {
  const std::int64_t end = clock_.now_ns() + std::llround(pace_.work_us * 1e3);
  while (clock_.now_ns() < end) {
  }
}

void PacedReplay::record_lost(std::int64_t now) noexcept {
  for (; recorded_ < tick_; ++recorded_) {
    TickRecord& record = records_[recorded_];
    record = {};
    record.step = static_cast<std::uint32_t>(step_of_tick(pace_.first_tick + recorded_, steps_));
    record.latency_ns = now - scheduled(recorded_);
  }
}

std::optional<std::size_t> PacedReplay::next() noexcept {
  if (tick_ > 0 && pace_.work_us > 0) do_other_work();
  if (eviction_ != nullptr) walked_ += eviction_->walk();
  const std::int64_t now = clock_.now_ns();
  while (tick_ < records_.size() && now >= scheduled(tick_ + 1)) ++tick_;
  without_sleep_ = now < scheduled(tick_) ? 0 : without_sleep_ + 1;
  overrun_ = without_sleep_ > pace_.overrun_ticks;
  if (tick_ >= records_.size() || overrun_) {
    record_lost(now);
    return std::nullopt;
  }
  if (now < scheduled(tick_)) clock_.sleep_until_ns(scheduled(tick_));
  return step_of_tick(pace_.first_tick + tick_, steps_);
}

TickRecord& PacedReplay::record_asked(std::uint64_t ticks, const Work& work) noexcept {
  const std::int64_t now = clock_.now_ns();
  record_lost(now);
  TickRecord& record = records_[recorded_++];
  record = {1,
            static_cast<std::uint32_t>(step_of_tick(pace_.first_tick + tick_, steps_)),
            now - scheduled(tick_),
            ticks,
            0,
            work};
  ++tick_;
  return record;
}

void run_idle(contestants::StepPacer& pacer) noexcept {
  while (pacer.next()) {
    const std::uint64_t before = contestants::TickClock::now();
    pacer.took(contestants::TickClock::now() - before, {}, {});
  }
}

}  // namespace touchmark::bench::workers
