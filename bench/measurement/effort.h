/// How much is measured. Times are what one contestant gets on one trajectory.
#pragma once

#include <algorithm>
#include <cstddef>

namespace touchmark::bench::measurement {

struct Effort {
  std::size_t repetitions = 11;  ///< many and short, for throughput; 0: verify only
  std::size_t latency_passes = 3;
  double pass_budget_ns = 35e6;  ///< a trajectory that takes longer to replay is cut to a sample of its steps
  double repetition_ns = 8e6;    ///< shorter passes are repeated until they last so long
  std::size_t cold_passes = 0;   ///< that the samples are spread over; 0: caches are left alone
  double cold_budget_ns = 1e9;   ///< for all samples, besides the least number of them
  std::size_t cold_samples = 400;      ///< at most so many with all caches emptied
  std::size_t cold_l2_samples = 2000;  ///< at most so many with the second-level cache emptied
  std::size_t line_samples = 0;        ///< queries whose cache lines are counted; 0: none
  std::size_t max_logged_steps = 0;    ///< Rows of at most so many steps keep a StepLog; 0: none does.
  std::size_t min_cold_samples = 5;    ///< A pass takes so many of either kind, however long they take.

  /// Returns the share of a pass in so many samples, rounded up. There are passes.
  std::size_t of_cold_pass(std::size_t samples) const noexcept {
    return (samples + cold_passes - 1) / cold_passes;
  }
  /// Takes all of `samples` with all caches emptied, and ten times as many with the second-level cache
  /// emptied, however long they take.
  void take_all_cold(std::size_t samples) noexcept {
    cold_passes = std::max<std::size_t>(cold_passes, 1);
    cold_samples = samples;
    min_cold_samples = cold_l2_samples = 10 * samples;
  }
};

/// How many samples with nothing asked each pass takes besides.
inline constexpr std::size_t cold_floor_samples = 1;

/// What --cache-lines counts of each row: slow, but the same in every run.
inline constexpr std::size_t usual_line_samples = 200, quick_line_samples = 50;

/// What queries with emptied caches add, however many contestants and trajectories there are.
inline constexpr std::size_t usual_cold_passes = 2, quick_cold_passes = 1;
inline constexpr std::size_t quick_cold_samples = 100, quick_cold_l2_samples = 1000;
inline constexpr double usual_cold_budget_ns = 16e9, quick_cold_budget_ns = 8e9;

inline constexpr Effort quick_effort{10, 3, 10e6, 4e6};

/// To verify and not to time: more steps in return.
inline constexpr Effort accuracy_effort{0, 0, 1e9, 0};

}  // namespace touchmark::bench::measurement
