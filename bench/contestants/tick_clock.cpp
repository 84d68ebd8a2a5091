#include "bench/contestants/tick_clock.h"

#include <algorithm>
#include <array>

namespace touchmark::bench::contestants {
namespace {

using Steady = std::chrono::steady_clock;

double measured_ns_per_tick() {
  const auto steady_start = Steady::now();
  const std::uint64_t start = TickClock::now();
  while (Steady::now() - steady_start < std::chrono::milliseconds(20)) {
  }
  const std::uint64_t stop = TickClock::now();
  const std::chrono::duration<double, std::nano> elapsed = Steady::now() - steady_start;
  return elapsed.count() / static_cast<double>(stop - start);
}

double median_reading_ticks() {
  std::array<std::uint64_t, 501> readings;
  std::uint64_t before = TickClock::now();
  for (std::uint64_t& reading : readings) {
    const std::uint64_t after = TickClock::now();
    reading = after - before;
    before = after;
  }
  std::nth_element(readings.begin(), readings.begin() + readings.size() / 2, readings.end());
  return static_cast<double>(readings[readings.size() / 2]);
}

}  // namespace

ClockCalibration calibrate_clock() {
  ClockCalibration clock(measured_ns_per_tick(), 0);
  measure_cost_anew(clock);
  return clock;
}

void measure_cost_anew(ClockCalibration& clock) {
  clock.cost_ns = median_reading_ticks() * clock.ns_per_tick;
}

}  // namespace touchmark::bench::contestants
