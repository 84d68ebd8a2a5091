/// The options of `touchmark gate`.
#pragma once

#include <cstddef>
#include <string>

#include "bench/cli/report_files.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/selectors.h"
#include "bench/regression/gate/paired_batch.h"

namespace touchmark::bench::cli {

struct ProgramContext;

struct GateOptions {
  contestants::Selectors selectors;
  std::string reference = "aabb-tree", baseline, tolerance = "7%", report;
  std::size_t rounds = regression::gate::GateEffort{}.rounds;
  bool write_baseline = false;
  ReportSelectors reports;
  WorkerSelectors workers;
};

void add_gate_options(CLI::App& command, ProgramContext& context, GateOptions& options);

/// Throws std::invalid_argument.
double checked_tolerance(const std::string& text);

}  // namespace touchmark::bench::cli
