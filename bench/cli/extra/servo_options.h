/// The options of `touchmark servo`.
#pragma once

#include <string>
#include <vector>

#include "bench/cli/extra/coupling_options.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/selectors.h"
#include "bench/experiments/servo/servo_row.h"
#include "bench/proxies/methods.h"

namespace touchmark::bench::cli {

struct ProgramContext;

struct ServoOptions {
  contestants::Selectors selectors;
  std::string seconds = "10", load, work_us = "0", cpu, out;
  bool proxy = false, evict = false;
  std::string method, max_work = std::to_string(proxies::usual_max_work);
  CouplingSelectors coupling;
  WorkerSelectors workers;
};

/// Sets the defaults as well.
void add_servo_options(CLI::App& command, ProgramContext& context, ServoOptions& options);

// All throw std::invalid_argument naming the option and the value.
/// The core of the loop.
int checked_core(const ServoOptions& options);
/// A proxy's radius is left at 0: it depends on the mesh.
experiments::servo::ServoSettings checked_settings(const ServoOptions& options, int core);
std::string checked_trajectory(const ServoOptions& options);

}  // namespace touchmark::bench::cli
