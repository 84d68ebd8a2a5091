/// The processor cores that a build may use.
#pragma once

#include <sched.h>

#include "bench/contestants/contestant_info.h"

namespace touchmark::bench::workers {

/// Lets the threads of a build run wherever the program may, until the end of its scope: else they would take
/// turns on the one core that a worker is kept on. A build of one thread stays on that core.
class BuildCores {
 public:
  explicit BuildCores(const contestants::ContestantSpec& spec) noexcept;
  BuildCores(const BuildCores&) = delete;
  BuildCores& operator=(const BuildCores&) = delete;
  ~BuildCores();

 private:
  cpu_set_t before_;
  bool is_wider_ = false;
};

}  // namespace touchmark::bench::workers
