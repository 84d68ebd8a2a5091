/// Throughput by Google Benchmark: how long a query takes when a trajectory is replayed as fast as it goes,
/// with no clock inside the loop. Runs in a worker.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/contestant.h"

namespace touchmark::bench {

struct Throughput {
  double ns_per_query = 0;      ///< elapsed, the mean over all passes
  double cpu_ns_per_query = 0;  ///< the process's own time: without what others took of the core
  std::uint64_t checksum = 0;   ///< of one pass
  bool steady = true;           ///< every pass had the same checksum
};

/// Hands --benchmark_* flags to the library. Those it does not know come back.
std::vector<std::string> initialize_throughput(const std::vector<std::string>& flags);

/// Replays all windows `passes` times (at least once) without forgetting the session in between.
Throughput measure_throughput(Contestant& contestant, const Course& course,
                              const std::vector<Window>& windows, std::int64_t passes);

}  // namespace touchmark::bench
