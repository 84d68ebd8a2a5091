/// How much is measured. Times are what one contestant gets on one trajectory.
#pragma once

#include <cstddef>

namespace touchmark::bench::measurement {

struct Effort {
  std::size_t repetitions = 15;  ///< many and short, for throughput; 0: verify only
  std::size_t latency_passes = 3;
  double pass_budget_ns = 50e6;  ///< a trajectory that takes longer to replay is cut to a sample of its steps
  double repetition_ns = 8e6;    ///< shorter passes are repeated until they last so long
  std::size_t cold_passes = 0;   ///< each of as many samples as follow; 0: caches are left alone
  std::size_t cold_samples = 50;      ///< with all caches emptied
  std::size_t cold_l2_samples = 500;  ///< with the second-level cache emptied
};

/// What --cold adds: enough samples for a p99 of the one and a p99.9 of the other.
inline constexpr std::size_t usual_cold_passes = 2;

inline constexpr Effort quick_effort{10, 3, 10e6, 4e6};

/// To verify and not to time: more steps in return.
inline constexpr Effort accuracy_effort{0, 0, 1e9, 0};

}  // namespace touchmark::bench::measurement
