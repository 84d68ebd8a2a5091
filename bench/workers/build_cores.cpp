#include "bench/workers/build_cores.h"

#include <unistd.h>

namespace touchmark::bench::workers {

/// The program that started this worker is its parent, and is not kept on a core.
BuildCores::BuildCores(const contestants::ContestantSpec& spec) noexcept {
  const auto threads = spec.values.all().find("threads");
  if (threads == spec.values.all().end() || threads->second == "1") return;
  cpu_set_t of_program;
  is_wider_ = sched_getaffinity(0, sizeof before_, &before_) == 0 &&
              sched_getaffinity(getppid(), sizeof of_program, &of_program) == 0 &&
              sched_setaffinity(0, sizeof of_program, &of_program) == 0;
}

BuildCores::~BuildCores() {
  if (is_wider_) sched_setaffinity(0, sizeof before_, &before_);
}

}  // namespace touchmark::bench::workers
