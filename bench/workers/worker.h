/// The inside of a worker process: builds one contestant and does what the program requests, see
/// worker_protocol.h.
#pragma once

#include "bench/contestants/roster.h"
#include "bench/workers/worker_roster.h"

namespace touchmark::bench::workers {

/// What a worker program's main function returns. Arguments are --benchmark_* flags. Ends when the program
/// closes the control socket.
int run_worker(int argc, char** argv, const contestants::Roster& roster, LoadPlugin load = nullptr);

}  // namespace touchmark::bench::workers
