/// How much is measured. Times are what one contestant gets on one trajectory.
#pragma once

#include <cstddef>

namespace touchmark::bench {

struct Effort {
  std::size_t repetitions = 5;  ///< of throughput; 0: verify only
  std::size_t latency_passes = 3;
  double pass_budget_ns = 100e6;  ///< a trajectory that takes longer to replay is cut to windows of steps
  double repetition_ns = 50e6;    ///< shorter passes are repeated until they last so long
};

inline constexpr Effort quick_effort{3, 3, 25e6, 20e6};

/// To verify and not to time: more steps in return.
inline constexpr Effort accuracy_effort{0, 0, 1e9, 0};

}  // namespace touchmark::bench
