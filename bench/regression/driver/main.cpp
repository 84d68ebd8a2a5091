/// The measuring half of the regression gate; scripts/regress builds it, runs it and judges.
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/regression/driver/commands.h"
#include "bench/support/failures.h"
#include "bench/support/system/denormals.h"

namespace {

using namespace touchmark::bench;

int fail(int status, const std::string& what) {
  fmt::print(stderr, "touchmark-regression: {}\n", what);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  support::restore_denormals();
  CLI::App program("Measures builds of the core for scripts/regress.", "touchmark-regression");
  program.require_subcommand(1);
  program.footer(
      "Example: touchmark-regression answers --plugin build/regress/head/plugin.so --out answers.csv\n");
  std::string plugin, out;
  regression::driver::Timing timing;

  auto* const answers = program.add_subcommand("answers", "work counters and checksums of every case");
  answers->add_option("--plugin", plugin)->required();
  answers->add_option("--out", out)->required();
  bool generated = false;
  answers->add_flag("--generated", generated, "leave out the cases whose mesh is a file");
  answers->callback([&] { regression::driver::write_answers(plugin, out, generated); });

  auto* const instructions = program.add_subcommand("instructions", "under callgrind: a dump for every case");
  instructions->add_option("--plugin", plugin)->required();
  instructions->callback([&] { regression::driver::count_instructions(plugin); });

  auto* const times = program.add_subcommand("times", "three builds in one process, in random order");
  times->add_option("--base", timing.base)->required();
  times->add_option("--control", timing.control, "a copy of base")->required();
  times->add_option("--head", timing.head)->required();
  times->add_option("--case", timing.only, "only these");
  times->add_option("--seed", timing.seed);
  times->add_option("--out", out)->required();
  times->callback([&] { regression::driver::write_times(timing, out); });

  try {
    program.parse(argc, argv);
    return support::exit_done;
  } catch (const CLI::Success& asked) {
    return program.exit(asked);
  } catch (const CLI::ParseError& error) {
    return fail(support::exit_bad_input, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(support::exit_bad_input, error.what());
  } catch (const std::bad_alloc&) {
    return fail(support::exit_resources, "out of memory");
  } catch (const std::exception& error) {
    return fail(support::exit_resources, error.what());
  }
}
