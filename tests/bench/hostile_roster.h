/// Contestants that misbehave in every way a rival has: the worker programs' tests run them.
#pragma once

#include "bench/contestant_info.h"

namespace touchmark::bench {

/// honest, aborts, aborts-at-build, divides-by-zero, throws, exits, hangs, hangs-at-build, refuses, lies,
/// fickle, touches-only, spins, spins-steadily, moody. They run in the program touchmark-hostile-worker.
const Roster& hostile_roster();

}  // namespace touchmark::bench
