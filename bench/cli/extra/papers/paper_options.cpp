#include "bench/cli/extra/papers/paper_options.h"

#include <CLI/CLI.hpp>

#include "bench/cli/options.h"

namespace touchmark::bench::cli {

void add_paper_options(CLI::App& command, PaperOptions& options) {
  add_value(command, "--out,--output", options.out, "DIR",
            "folder for the CSV files, the report and the pictures' data");
  add_value(command, "--radius", options.radius, "LENGTH",
            "the probe's, in mesh units or % of the box diagonal");
  add_value(command, "--steps", options.steps, "N", "of the trajectory that every detector is given");
  add_value(command, "--seed", options.seed, "N", "of the trajectory and of the order of measuring");
  command.add_flag("--quick", options.quick, "few steps, rounds and cases: to see that it works");
}

}  // namespace touchmark::bench::cli
