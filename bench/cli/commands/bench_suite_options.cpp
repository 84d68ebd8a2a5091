#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/extra/bench_suite.h"
#include "bench/cli/options.h"

namespace touchmark::bench::cli {

void add_suite(CLI::App& command, bool& suite, std::string& cells, std::string& minutes) {
  CLI::Option* const flag = command.add_flag("--suite", suite,
                                             "a score over many meshes, motions, speeds, queries and reaches "
                                             "instead; with --mesh on that mesh alone");
  add_value(command, "--cells", cells, "N", "of the suite: how many a mesh, or all; default: 6, quick 2")
      ->needs(flag);
  add_value(command, "--minutes", minutes, "M",
            "of the suite: what does not fit is left out and said so; default: no limit")
      ->needs(flag);
}

void expect_options_of_suite(const CLI::App& command) {
  for (const char* const option : {"--scene", "--poses", "--trajectory", "--query", "--radius", "--reach",
                                   "--unit", "--columns", "--motion-scale", "--rate", "--drape", "--frontier",
                                   "--steps-out", "--cold", "--cache-lines", "--work", "--markdown"})
    if (command.count(option) > 0)
      throw std::invalid_argument(fmt::format("{} does not go with --suite", option));
}

}  // namespace touchmark::bench::cli
