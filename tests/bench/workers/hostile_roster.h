/// Contestants that misbehave in every way a rival has: the worker programs' tests run them.
#pragma once

#include <cstdint>

#include "bench/contestants/roster.h"

namespace touchmark::bench::workers {

/// honest, aborts, aborts-at-build, divides-by-zero, throws, exits, hangs, hangs-far-away, hangs-at-build,
/// refuses, lies, fickle, touches-only, paced, moody, stalls, and makes-later, which is a lazy GridGroup;
/// settles, drifts and lies-later, whose answers depend on those before. They run in the program
/// touchmark-hostile-worker.
const contestants::Roster& hostile_roster();

/// What the answers of this process's contestants so far claim to have cost, in nanoseconds.
std::int64_t hostile_ns() noexcept;

}  // namespace touchmark::bench::workers
