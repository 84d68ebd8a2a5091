/// A contestant in its worker process: requests as functions. A worker that failed is started anew, and its
/// contestant built anew, when the next request comes; a failed build is not tried again.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bench/contestants/contestant_info.h"
#include "bench/workers/shared_workload.h"
#include "bench/workers/timing/cache_lines.h"
#include "bench/workers/worker_process.h"
#include "bench/workers/worker_protocol.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::workers {

struct WorkerOptions {
  std::vector<std::string> flags;  ///< --benchmark_*
  std::optional<int> core;         ///< the core that all workers run on
  std::chrono::milliseconds build_timeout{120'000};
  std::chrono::milliseconds request_timeout{30'000};
  bool calibrate_clock = true;  ///< needed by latency(), takes 20 ms
  bool show_output = false;
};

/// The shared memory of all workers of one workload.
class SharedArena {
 public:
  /// The output has room for so many steps where the longest trace has fewer. Throws ResourceError when
  /// memory is short.
  SharedArena(const workload::Workload& workload, WorkerOptions options, std::size_t min_output_steps = 0);

  const WorkerOptions& options() const noexcept { return options_; }
  const WorkloadLayout& layout() const noexcept { return layout_; }
  const OutputBuffers& buffers() const noexcept { return buffers_; }
  WorkerLaunch launch(const std::string& program) const;

 private:
  WorkerOptions options_;
  WorkloadLayout layout_;
  SharedMemory input_;
  SharedMemory output_;
  OutputBuffers buffers_;
};

class ContestantProcess {
 public:
  /// The arena must outlive it.
  ContestantProcess(const SharedArena& arena, contestants::ContestantSpec spec, std::string worker_program);

  const contestants::ContestantSpec& spec() const noexcept { return spec_; }
  /// Set once the first request came through.
  const Opened& opened() const noexcept { return opened_; }

  // All throw WorkerFailure, whose what() is the status for the row, ResourceError or Interrupted.
  const Built& build();
  /// Counts in a worker of its own, which is built for this: see cache_lines.h.
  CacheLines count_cache_lines(const Task& task, std::size_t samples) const;
  /// Builds a lazily built detector anew if it was asked anything since: all of its parts are to
  /// be built again. Does nothing for others, which would not change.
  void rebuild_if_lazy();
  /// Starts and builds first, if that was not done.
  template <class Kind>
  typename Kind::Reply ask(const Kind& request) {
    constexpr bool of_steps = requires { request.task; };
    start();
    asked_ = asked_ || of_steps;
    std::chrono::milliseconds timeout =
        of_steps ? arena_.options().request_timeout : arena_.options().build_timeout;
    if constexpr (requires { request.paced_time(); }) timeout += request.paced_time();
    return std::get<typename Kind::Reply>(exchange(request, timeout));
  }

  /// Seconds that all its workers were waited for, building included.
  double busy_s() const noexcept { return busy_s_; }
  /// Ends the worker. The next request starts one anew.
  void end() { process_.reset(); }
  /// From now on requests throw a WorkerFailure of this status.
  void mark_failed(std::string status);

 private:
  void start();
  Built request_build();
  Reply exchange(const Request& request, std::chrono::milliseconds timeout);

  const SharedArena& arena_;
  contestants::ContestantSpec spec_;
  std::string program_;
  std::unique_ptr<WorkerProcess> process_;
  Opened opened_;
  std::optional<Built> built_;
  bool asked_ = false;  ///< about steps, since it was built
  std::string failed_build_;
  double busy_s_ = 0;
};

}  // namespace touchmark::bench::workers
