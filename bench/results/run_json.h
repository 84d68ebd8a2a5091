/// run.json: what results.csv was measured with.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/measurement/effort.h"
#include "bench/measurement/steadiness.h"
#include "bench/results/system_info.h"
#include "bench/workers/contestant_process.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::results {

struct RunDescription {
  std::string run_id;
  SystemInfo system;             ///< as it was at the start
  bool flushed_to_zero = false;  ///< denormals were off in this program at its start; they were put on
  std::vector<std::string> arguments;
  workload::Query query = workload::Query::nearest;
  std::uint64_t seed = 0;
  measurement::Effort effort;
  std::optional<int> core;                                    ///< the workers'
  bool finished = true;                                       ///< false after Ctrl-C
  std::vector<measurement::Steadiness> steadiness;            ///< for what was timed
  std::vector<std::pair<std::string, std::string>> left_out;  ///< trajectory and contestant, by a filter
};

/// Describes a run that begins now: an id, the system, and the command line without the program's name.
RunDescription begun_run(int argc, const char* const* argv);

std::string run_json(const RunDescription& run, const workload::Workload& workload,
                     const std::deque<workers::ContestantProcess>& contestants);

/// One for the rows of several meshes: the first of these texts of run_json (at least one), with `meshes`, a
/// list of what each was about.
std::string joined_run_json(const std::vector<std::string>& runs, bool finished);

/// Date and time, and four digits that tell runs of one second apart.
std::string new_run_id(const SystemInfo& system);

}  // namespace touchmark::bench::results
