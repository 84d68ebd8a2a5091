/// What `touchmark servo` prints.
#pragma once

#include <string>
#include <vector>

#include "bench/experiments/servo/real_time_host.h"
#include "bench/experiments/servo/servo_row.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::experiments::servo {

/// Returns the loop's settings, what the system allowed, and what of the machine spoils real time.
std::string circumstances(const ServoSettings& settings, const workload::Workload& workload, int core,
                          const std::vector<ServoRow>& rows, const RealTimeHost& host);

/// A line for each contestant's loop and for its idle loop.
std::string loop_table(const ServoSettings& settings, const std::vector<ServoRow>& rows);

/// The worst ticks of each contestant, with the commands that repeat them.
std::string worst_ticks(const workload::Workload& workload, const std::vector<ServoRow>& rows);

/// Returns a line for each contestant with its reason, and one for all of them: "holds", "does not hold" or
/// "inconclusive".
std::string verdict_lines(const ServoSettings& settings, const std::vector<ServoRow>& rows);

Verdict verdict_on_all(const std::vector<ServoRow>& rows);

}  // namespace touchmark::bench::experiments::servo
