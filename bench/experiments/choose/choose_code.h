/// C++ that a haptics program pastes: the chosen class with its options and the query.
#pragma once

#include <string>

#include "bench/contestants/roster.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::experiments::choose {

/// What the program asks in each tick.
struct Use {
  workload::Query query;
  bool proxy = false;  ///< it steps a proxy, which asks contacts and sweeps
};

/// Returns a source file that compiles against the installed library, with a Scene where the workload is of
/// bodies; for another library's detector, and for options that no program sets, a line that says so. The
/// probe's radius and the reach are the workload's.
std::string code_for(const contestants::Roster& roster, const contestants::ContestantSpec& spec,
                     const workload::Workload& workload, const Use& use);

}  // namespace touchmark::bench::experiments::choose
