/// Ctrl-C and SIGTERM as something to ask for between two requests instead of a sudden end.
#pragma once

#include <chrono>

#include "bench/support/failures.h"

namespace touchmark::bench::support {

/// Thrown once the deadline that the command set is over.
class OutOfTime : public Interrupted {};

using Deadline = std::chrono::steady_clock::time_point;

/// From now on the first SIGINT or SIGTERM only sets a flag; the second one ends the program at once.
void watch_for_interrupts(Deadline deadline = Deadline::max());

/// Throws Interrupted if a signal came, OutOfTime after the deadline.
void check_for_interrupt();

}  // namespace touchmark::bench::support
