/// A clock that goes on by itself at every look, by what a test says is taken at some of them.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "bench/workers/timing/paced_replay.h"

namespace touchmark::bench::experiments::servo {

class SimulatedClock final : public workers::WakeClock {
 public:
  std::int64_t now_ns() noexcept override { return now_; }
  /// Late by what `late_by` holds for so many sleeps before this one.
  void sleep_until_ns(std::int64_t time) noexcept override {
    const auto found = late_by.find(sleeps++);
    now_ = time + (found == late_by.end() ? 0 : found->second);
  }
  void pass(std::int64_t ns) noexcept { now_ += ns; }

  std::map<int, std::int64_t> late_by;
  int sleeps = 0;

 private:
  std::int64_t now_ = 5'000;
};

/// Answers all ticks; a query takes what `takes` says for its number, else `usual_ns`. Returns the records.
inline std::vector<workers::TickRecord> paced(const workers::Pace& pace, std::size_t steps, std::size_t ticks,
                                              SimulatedClock& clock,
                                              const std::map<int, std::int64_t>& takes = {},
                                              std::int64_t usual_ns = 1'000, bool* ended = nullptr) {
  std::vector<workers::TickRecord> records(ticks);
  workers::PacedReplay replay(pace, steps, clock, records);
  for (int query = 0; replay.next(); ++query) {
    const auto found = takes.find(query);
    const std::int64_t ns = found == takes.end() ? usual_ns : found->second;
    clock.pass(ns);
    replay.took(static_cast<std::uint64_t>(ns), {}, {});
  }
  records.resize(replay.recorded());
  if (ended != nullptr) *ended = replay.overrun();
  return records;
}

}  // namespace touchmark::bench::experiments::servo
