/// The command line that prints one contestant's answer to one step again.
#pragma once

#include <string>

#include "bench/contestants/selectors.h"
#include "bench/measurement/result_row.h"
#include "bench/workload/workload.h"

namespace touchmark::bench {

/// "touchmark query ... --step ", to which the step's number is to be added. `mesh` and `trajectories` are as
/// they were selected, the latter in the order of the workload's.
std::string repeat_command(const Selectors& selectors, const std::string& mesh,
                           const std::vector<std::string>& trajectories, const Workload& workload,
                           const ResultRow& row);

}  // namespace touchmark::bench
