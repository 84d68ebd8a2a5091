/// Throughput by Google Benchmark: how long a query takes when a trajectory is replayed as fast as it goes,
/// with the clock read between ranges only; and the times of single steps. Runs in a worker.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/workers/shared_workload.h"
#include "bench/workers/worker_protocol.h"

namespace touchmark::bench::workers {

/// Hands --benchmark_* flags to the library. Those it does not know come back.
std::vector<std::string> initialize_throughput(const std::vector<std::string>& flags);

/// Replays all ranges `passes` times (at least once) without forgetting the session in between.
Timed measure_throughput(contestants::Contestant& contestant, const workload::QueryTrace& trace,
                         const std::vector<workload::StepRange>& ranges, std::int64_t passes);

/// Replays all ranges `passes` times, each range timed separately: a sample is the shorter of its elapsed and
/// its processor time. A range is replayed `replays` times in a sample, more than once only where there is no
/// other. Bodies of a scene are placed within a step's time. `samples` holds those of the ranges in turn,
/// pass by pass, each divided by `replays`. The last range is replayed before, so that the first does not pay
/// for what others did to the caches.
Timed sample_throughput(contestants::Contestant& contestant, const workload::QueryTrace& trace,
                        const std::vector<workload::StepRange>& ranges, std::int64_t passes,
                        std::int64_t replays);

/// Replays all ranges once with the clock read at each step. The ticks that steps took, and those that the
/// detector prepared for, are left in the buffers.
Timed clock_steps(contestants::Contestant& contestant, const workload::QueryTrace& trace,
                  const std::vector<workload::StepRange>& ranges, OutputBuffers& buffers);

}  // namespace touchmark::bench::workers
