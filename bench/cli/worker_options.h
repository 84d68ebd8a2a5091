/// The options that say how workers are treated: shared by the commands that start them.
#pragma once

#include <string>

#include "bench/workers/contestant_process.h"

namespace CLI {
class App;
}

namespace touchmark::bench::cli {

/// As the command line gave them.
struct WorkerSelectors {
  std::string timeout;  ///< empty: the defaults of WorkerOptions
  bool show_output = false;
};

void add_worker_selectors(CLI::App& command, WorkerSelectors& selectors);

/// Throws std::invalid_argument.
workers::WorkerOptions worker_options(const WorkerSelectors& selectors);

}  // namespace touchmark::bench::cli
