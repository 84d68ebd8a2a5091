/// How much is measured. Times are what one contestant gets on one trajectory.
#pragma once

#include <cstddef>

namespace touchmark::bench::measurement {

struct Effort {
  std::size_t repetitions = 15;  ///< many and short, for throughput; 0: verify only
  std::size_t latency_passes = 3;
  double pass_budget_ns = 50e6;  ///< a trajectory that takes longer to replay is cut to a sample of its steps
  double repetition_ns = 8e6;    ///< shorter passes are repeated until they last so long
};

inline constexpr Effort quick_effort{10, 3, 10e6, 4e6};

/// To verify and not to time: more steps in return.
inline constexpr Effort accuracy_effort{0, 0, 1e9, 0};

}  // namespace touchmark::bench::measurement
