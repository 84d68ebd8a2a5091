/// The options of `touchmark choose`.
#pragma once

#include <string>
#include <vector>

#include "bench/cli/worker_options.h"
#include "bench/contestants/selectors.h"
#include "bench/experiments/choose/decision.h"
#include "bench/support/system/interrupt.h"

namespace touchmark::bench::cli {

struct ProgramContext;

struct ChooseOptions {
  contestants::Selectors selectors;
  std::vector<std::string> motions;
  std::string share = "10%", minutes = "3", memory, out;
  bool quick = false, proxy = false;
  WorkerSelectors workers;
};

/// Sets the defaults as well.
void add_choose_options(CLI::App& command, ProgramContext& context, ChooseOptions& options);

// All throw std::invalid_argument naming the option and the value.
experiments::choose::Limits checked_limits(const ChooseOptions& options);
/// Returns the selectors of what is compared: for a proxy it is the sweep.
contestants::Selectors checked_selectors(const ChooseOptions& options);
/// Returns how long the command may take.
support::Deadline::duration checked_minutes(const ChooseOptions& options);

}  // namespace touchmark::bench::cli
