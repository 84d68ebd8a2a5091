#pragma once

#include <ctime>

namespace touchmark::bench::support {

/// What this thread has had of the processor: what others took of a shared one does not count.
inline double processor_ns() noexcept {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

}  // namespace touchmark::bench::support
