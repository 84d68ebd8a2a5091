/// A loop that asks one question a tick, each at its scheduled time, as a haptic device does. The clock is
/// handed in, so that tests say what time it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "bench/contestants/contestant.h"
#include "bench/workers/timing/eviction.h"
#include "bench/workload/answer.h"
#include "core/detector.h"

namespace touchmark::bench::workers {

/// A clock that can be slept by; nanoseconds since a start of its own.
class WakeClock {
 public:
  WakeClock() = default;
  WakeClock(const WakeClock&) = delete;
  WakeClock& operator=(const WakeClock&) = delete;
  virtual ~WakeClock() = default;

  virtual std::int64_t now_ns() noexcept = 0;
  /// Returns at that time or later.
  virtual void sleep_until_ns(std::int64_t time) noexcept = 0;
};

/// CLOCK_MONOTONIC, by clock_nanosleep on absolute times.
class MonotonicClock final : public WakeClock {
 public:
  std::int64_t now_ns() noexcept override;
  void sleep_until_ns(std::int64_t time) noexcept override;
};

/// What came of one tick. Plain bytes: it lies where an answer lies in the output buffers.
struct TickRecord {
  std::uint32_t asked = 0;        ///< 0: the tick was lost, its whole period had passed before it could begin
  std::uint32_t step = 0;         ///< the trace's
  std::int64_t latency_ns = 0;    ///< from the scheduled start to the first answer after it
  std::uint64_t query_ticks = 0;  ///< the query alone, by TickClock, one reading included; lost: 0
  std::uint64_t checksum = 0;     ///< tick_checksum of the answer
  Work work;
};
static_assert(sizeof(TickRecord) <= sizeof(workload::Answer) && std::is_trivially_copyable_v<TickRecord>);

struct Pace {
  double rate_hz = 1000;
  unsigned slowdown = 1;           ///< A tick comes every so many periods of the rate.
  double work_us = 0;              ///< other work on the same core, after each answer
  std::uint64_t first_tick = 0;    ///< how many ticks of the trajectory were before
  std::size_t overrun_ticks = 50;  ///< a loop that finds no time to sleep before so many in a row is ended
};

/// Returns what a loop's answers are compared by. Whoever may name any of several equally near triangles
/// names another one after other ticks, and no two loops have the same: of that only whether there was
/// something counts.
inline std::uint64_t tick_checksum(const workload::Answer& answer, const Accuracy& accuracy) noexcept {
  workload::Checksum checksum;
  checksum.add(accuracy.names_exactly ? answer : workload::Answer{answer.found});
  return checksum.value();
}

/// Returns the step of a tick: along the trace to its end, back to its beginning, and so on.
std::size_t step_of_tick(std::uint64_t tick, std::size_t steps) noexcept;

/// The tick that begins after another's answer has come too late for it is lost: the device has had to go on
/// with the old force. The trajectory goes by time, so its step is left out.
class PacedReplay final : public contestants::StepPacer {
 public:
  /// As many ticks as `records` has room for. The first begins a period from now. At least one step. The
  /// caches are emptied before each tick where there is an `eviction`, which must outlive the replay.
  PacedReplay(const Pace& pace, std::size_t steps, WakeClock& clock, std::span<TickRecord> records,
              const Accuracy& accuracy = certified, EvictionBuffer* eviction = nullptr) noexcept;

  std::optional<std::size_t> next() noexcept override;
  void took(std::uint64_t ticks, const workload::Answer& answer, const Work& work) noexcept override {
    took_step(
        ticks, [&] { return tick_checksum(answer, accuracy_); }, work);
  }
  /// Takes what is no answer to a query; `checksum()` is called once the tick's time is known.
  template <class Sum>
  void took_step(std::uint64_t ticks, const Sum& checksum, const Work& work) noexcept {
    record_asked(ticks, work).checksum = checksum();
  }

  /// Ticks with a record: all, unless the loop was ended.
  std::size_t recorded() const noexcept { return recorded_; }
  /// True if the loop was ended since it found no time to sleep.
  bool overrun() const noexcept { return overrun_; }

 private:
  std::int64_t scheduled(std::size_t tick) const noexcept;
  void record_lost(std::int64_t now) noexcept;
  TickRecord& record_asked(std::uint64_t ticks, const Work& work) noexcept;
  void do_other_work() noexcept;

  Pace pace_;
  std::size_t steps_;
  WakeClock& clock_;
  std::span<TickRecord> records_;
  Accuracy accuracy_;  // the answers'
  EvictionBuffer* eviction_;
  double period_ns_;
  std::int64_t start_ns_;
  std::size_t tick_ = 0;           // the next one, or the one that is being asked
  std::size_t recorded_ = 0;       // ticks before tick_ that are not among these are lost
  std::size_t without_sleep_ = 0;  // ticks asked since it slept
  bool overrun_ = false;
  std::uint64_t walked_ = 0;
};

/// Runs the loop with nothing asked: what the machine alone makes of it.
void run_idle(contestants::StepPacer& pacer) noexcept;

}  // namespace touchmark::bench::workers
