/// The outside of a worker process: starts it, sends requests, waits with a deadline, and says how it ended.
#pragma once

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/types.h>

#include "bench/workers/line_channel.h"
#include "bench/workers/worker_protocol.h"

namespace touchmark::bench::workers {

/// The worker did not answer; what() is the status for its row: "timeout", "crashed:SIGSEGV",
/// "crashed:exit 3".
class WorkerFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct WorkerLaunch {
  std::string program;             ///< file name of a program that lies beside this one
  std::vector<std::string> flags;  ///< --benchmark_*
  int input = -1;                  ///< descriptors of shared memory
  int output = -1;
  std::optional<int> core;              ///< the only processor core it may run on
  bool show_output = false;             ///< false: what the contestant's library prints goes to /dev/null
  std::vector<std::string> under = {};  ///< a program's path and its arguments, which runs the worker
};

/// Ends with the object, and with the program. Ctrl-C does not reach it.
class WorkerProcess {
 public:
  /// Throws ResourceError when it cannot be started.
  explicit WorkerProcess(const WorkerLaunch& launch);
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;
  ~WorkerProcess();

  /// Throws WorkerFailure (the process is gone then), Interrupted, or ResourceError where the machine, not
  /// the contestant, kept the worker from answering: no descriptor, memory or processor time was left for it,
  /// or it ended before it knew whom to run.
  Reply ask(const Request& request, std::chrono::milliseconds timeout);

 private:
  struct Ending {
    int status = 0;  ///< waitpid's
    bool out_of_time = false;
  };
  Ending end();  // makes sure it is gone and says how it went
  [[noreturn]] void explain(const Ending& ending) const;

  std::string program_;
  bool replied_ = false;
  bool loads_plugin_ = false;  ///< so that an end may be the plug-in's, before any reply
  pid_t process_ = -1;
  int control_ = -1;
  LineChannel channel_{-1};
};

/// Returns true if there is such a program beside this one.
bool worker_program_exists(const std::string& program);

}  // namespace touchmark::bench::workers
