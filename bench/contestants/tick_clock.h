/// The clock of the latency pass: the processor's time stamp counter where it can be used, else steady_clock.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace touchmark::bench::contestants {

struct TickClock {
#if defined(__x86_64__)
  static constexpr const char* name = "rdtscp";
  /// rdtscp waits for the instructions before it, so a step's own work is inside its ticks.
  static std::uint64_t now() noexcept {
    unsigned core = 0;
    return __rdtscp(&core);
  }
#else
  static constexpr const char* name = "steady_clock";
  static std::uint64_t now() noexcept {
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
  }
#endif
};

/// Measured, not assumed, when a worker starts. It has no default, which would pass ticks off as nanoseconds.
struct ClockCalibration {
  ClockCalibration(double nanoseconds_per_tick, double cost) noexcept
      : ns_per_tick(nanoseconds_per_tick), cost_ns(cost) {}

  /// Returns how long that was, without the clock's cost; 0 where the clock does not tell it from nothing.
  double ns_of(std::uint64_t ticks) const noexcept {
    return std::max(0.0, static_cast<double>(ticks) * ns_per_tick - cost_ns);
  }

  double ns_per_tick;
  double cost_ns;  ///< the median of two readings in a row: what every clocked step includes
};

/// Takes about 20 ms.
ClockCalibration calibrate_clock();
/// Measures the cost anew, which takes some microseconds: a virtual machine's may change within seconds.
void measure_cost_anew(ClockCalibration& clock);

}  // namespace touchmark::bench::contestants
