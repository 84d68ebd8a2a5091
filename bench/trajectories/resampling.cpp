#include "bench/trajectories/resampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace touchmark::bench::trajectories {
namespace {

constexpr double max_interval = 1.5;  // of usual ones; with a row missing it is 2

/// How far a tick may be from a row's time by rounding alone: that of the times as read, of start + tick/rate
/// and of their difference, half a unit in the last place each.
double rounding_of(double start, double time) {
  return 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(start), std::abs(time));
}

}  // namespace

std::size_t first_gap(const std::vector<double>& times_s) {
  if (times_s.size() < 3) return 0;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times_s.size(); ++i) intervals.push_back(times_s[i] - times_s[i - 1]);
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>((intervals.size() - 1) / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  const double limit = max_interval * *middle;
  for (std::size_t i = 1; i < times_s.size(); ++i)
    if (times_s[i] - times_s[i - 1] > limit) return i;
  return 0;
}

double ticks_at(const Trajectory& recorded, double rate_hz) {
  const double start = recorded.times_s.front(), end = recorded.times_s.back();
  return std::floor((end - start + rounding_of(start, end)) * rate_hz) + 1;
}

Trajectory resampled(const Trajectory& recorded, double rate_hz, std::size_t most) {
  const std::vector<double>& times = recorded.times_s;
  const double ticks = ticks_at(recorded, rate_hz);
  const auto count = static_cast<std::size_t>(most > 0 ? std::min(ticks, static_cast<double>(most)) : ticks);
  Trajectory result{recorded.name, {}, {}, {}};
  result.positions.reserve(count);
  std::size_t row = 0;  // the last one that is not after the tick
  for (std::size_t tick = 0; tick < count; ++tick) {
    const double time = times.front() + static_cast<double>(tick) / rate_hz;
    const double rounding = rounding_of(times.front(), time);
    while (row + 1 < times.size() && times[row + 1] <= time + rounding) ++row;
    const bool at_row = row + 1 == times.size() || time - times[row] <= rounding;
    const double part = at_row ? 0 : (time - times[row]) / (times[row + 1] - times[row]);
    const auto between = [&](const auto& values) {
      using Value = std::decay_t<decltype(values[row])>;
      if (at_row) return values[row];
      return Value((1 - part) * values[row] + part * values[row + 1]);
    };
    result.positions.push_back(between(recorded.positions));
    if (!recorded.radii.empty()) result.radii.push_back(between(recorded.radii));
    result.times_s.push_back(time);
  }
  return result;
}

}  // namespace touchmark::bench::trajectories
