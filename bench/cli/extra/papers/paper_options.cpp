#include "bench/cli/extra/papers/paper_options.h"

#include <CLI/CLI.hpp>

namespace touchmark::bench::cli {
void add_paper_options(CLI::App& command, PaperOptions& options) {
  command
      .add_option("--out,--output", options.out,
                  "folder for the CSV files, the report and the pictures' data")
      ->type_name("DIR")
      ->capture_default_str();
  command.add_option("--radius", options.radius, "the probe's, in mesh units or % of the box diagonal")
      ->type_name("LENGTH")
      ->capture_default_str();
  command.add_option("--steps", options.steps, "of the trajectory that every detector is given")
      ->type_name("N");
  command.add_option("--seed", options.seed, "of the trajectory and of the order of measuring")
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--quick", options.quick, "few steps, rounds and cases: to see that it works");
}

}  // namespace touchmark::bench::cli
