/// Every contestant this program was built with. bench/CMakeLists.txt finds their entries and writes what
/// calls them.
#pragma once

#include <string>
#include <vector>

#include "bench/contestants/roster.h"

namespace touchmark::bench::contestants {

/// Returns our own detectors and the rivals.
const Roster& roster();

/// Returns what the entries of bench/contestants/own say.
std::vector<ContestantInfo> own_entries();

/// Returns what the entries of the folders of baselines/ say, and the names of rivals that are not built in.
std::vector<ContestantInfo> rival_entries();

}  // namespace touchmark::bench::contestants
