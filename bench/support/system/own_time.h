#pragma once

#include <algorithm>
#include <chrono>

#include <sys/resource.h>

#include "bench/support/system/processor_time.h"

namespace touchmark::bench::support {

/// Whether what is timed may have others do its work: a worker of plug-ins says so before it times anything.
/// A thread of ours gives its core up of its own accord only by accident, where the system is busy.
inline bool others_may_work = false;

/// Returns how often this thread has given its core up of its own accord, to sleep or to wait for somebody; 0
/// where nobody else may work for it.
inline long waits_so_far() noexcept {
  if (!others_may_work) return 0;
  rusage used{};
  ::getrusage(RUSAGE_THREAD, &used);
  return used.ru_nvcsw;
}

/// Returns how often others have taken this thread's core.
inline long preemptions_so_far() noexcept {
  rusage used{};
  ::getrusage(RUSAGE_THREAD, &used);
  return used.ru_nivcsw;
}

/// The time of what this thread does from the construction on, without what others took of its core. Where it
/// waits, as a plug-in does that has another thread, process or device do its work, there is no such time: it
/// is the time that passed.
class OwnTime {
 public:
  struct Taken {
    double ns = 0;
    bool interrupted = false;  ///< others took more than a sixth of the time that passed
  };

  Taken so_far() const noexcept {
    const Clock::time_point end = Clock::now();
    const double processor = processor_ns() - processor_start_;
    const double elapsed = std::chrono::duration<double, std::nano>(end - start_).count();
    if (waits_so_far() != waits_start_) return {elapsed, false};
    constexpr double undisturbed = 1.2;  // elapsed over processor time, at most
    return {std::min(elapsed, processor), elapsed > undisturbed * processor};
  }

 private:
  using Clock = std::chrono::steady_clock;
  // In this order: reading the others is outside of what the last one begins.
  long waits_start_ = waits_so_far();
  double processor_start_ = processor_ns();
  Clock::time_point start_ = Clock::now();
};

}  // namespace touchmark::bench::support
