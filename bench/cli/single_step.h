/// One contestant's answer to one step of a trace: to look at an answer that was found wrong.
#pragma once

#include <cstddef>
#include <string>

#include "bench/contestants/roster.h"
#include "bench/workers/contestant_process.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::cli {

/// replayed: the session has answered all steps before this one. fresh: none.
enum class SessionBefore { replayed, fresh };

/// The worker's end as the user caused it, or as the contestant's failure.
[[noreturn]] void explain(const workers::WorkerFailure& failure, const std::string& contestant);

/// Throws std::invalid_argument where it does not answer such queries.
void check_it_answers(const workers::Built& built, workload::Query query, const std::string& contestant);

/// The header and the step's row as `touchmark query` prints them. Says on stderr where the other kind of
/// session has another answer. Throws std::invalid_argument for a step that the trace does not have,
/// ResourceError or Interrupted.
std::string rows_of_step(const contestants::Roster& roster, const workload::Workload& workload,
                         const workers::WorkerOptions& workers, const contestants::ContestantSpec& spec,
                         const workers::Task& task, std::size_t step, SessionBefore session);

}  // namespace touchmark::bench::cli
