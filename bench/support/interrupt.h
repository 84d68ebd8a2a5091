/// Ctrl-C and SIGTERM as something to ask for between two requests instead of a sudden end.
#pragma once

namespace touchmark::bench::support {

/// From now on the first SIGINT or SIGTERM only sets a flag; the second one ends the program at once.
void watch_for_interrupts();

/// Throws Interrupted if one came.
void check_for_interrupt();

}  // namespace touchmark::bench::support
