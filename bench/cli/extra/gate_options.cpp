#include "bench/cli/extra/gate_options.h"

#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/options.h"
#include "bench/cli/program.h"
#include "bench/cli/selector_options.h"
#include "bench/support/checked.h"
#include "bench/support/length.h"

namespace touchmark::bench::cli {
namespace {

constexpr const char* gate_footer =
    R"(Exit status 0: no slower than the baseline, or by less than the tolerance. 1: slower, and a second batch
agrees; or other answers or more work than in the baseline; or wrong answers. 4: inconclusive, since the
reference, measured twice in every round, did not measure equal to itself.
Example: touchmark gate --mesh part.stl --trajectory hand.csv --detector grid-group --baseline gate.csv --write-baseline
         touchmark gate --mesh part.stl --trajectory hand.csv --detector grid-group --baseline gate.csv
)";

}  // namespace

double checked_tolerance(const std::string& text) {
  const double value = support::parse_share(text);
  if (!(value > 0 && value < 1))
    throw support::bad_value("--tolerance", text, "above 0 and below 100%, as 7%");
  return value;
}

void add_gate_options(CLI::App& command, ProgramContext& context, GateOptions& options) {
  add_selectors(command, context, options.selectors);
  add_scene_selectors(command, options.selectors);
  add_value(command, "--reference", options.reference, "D", "the contestant whose time is the unit");
  add_value(command, "--baseline", options.baseline, "FILE",
            "CSV file of ratios; it may come from another machine")
      ->required();
  command.add_flag("--write-baseline", options.write_baseline, "measure, and write the rows of --baseline");
  add_value(command, "--tolerance", options.tolerance, "PERCENT", "how much slower is not a fault");
  add_value(command, "--rounds", options.rounds, "N", "turns of each contestant in a batch");
  add_value(command, "--report", options.report, "FILE", "CSV file of what was found");
  add_junit(command, options.reports);
  add_markdown(command, options.reports);
  add_worker_selectors(command, options.workers);
  command.footer(gate_footer);
}

}  // namespace touchmark::bench::cli
