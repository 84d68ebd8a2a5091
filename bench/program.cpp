#include "bench/program.h"

#include <algorithm>
#include <cstdio>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/build_info.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench {
namespace {

using AddCommand = void (*)(CLI::App& program, ProgramContext& context);

// One line a command.
constexpr AddCommand commands[] = {
    add_bench, add_verify, add_list, add_mesh, add_query,
};

/// One line whatever the library or a file put into it.
std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

int fail(int status, std::string_view what) {
  fmt::print(stderr, "touchmark: {}\n", one_line(std::string(what)));
  return status;
}

int parse_and_run(CLI::App& program, ProgramContext& context) {
  try {
    program.parse(context.argc, context.argv);
  } catch (const CLI::CallForHelp& help) {
    return program.exit(help);
  } catch (const CLI::CallForAllHelp& help) {
    return program.exit(help);
  } catch (const CLI::CallForVersion& version) {
    return program.exit(version);
  } catch (const CLI::ParseError& error) {
    return fail(exit_bad_input, fmt::format("{} (touchmark --help)", one_line(error.what())));
  }
  return context.status;
}

}  // namespace

int run_program(int argc, char** argv, const Roster& roster) {
  ProgramContext context{roster, argc, argv};
  CLI::App program("Which collision detector can serve a haptic loop.", "touchmark");
  program.set_version_flag("--version", std::string("touchmark ") + build_info().version);
  program.require_subcommand(1);
  program.footer("Example: touchmark bench --mesh bunny --trajectory slide --out results/today\n");
  for (const AddCommand add : commands) add(program, context);

  try {
    return parse_and_run(program, context);
  } catch (const std::invalid_argument& error) {
    return fail(exit_bad_input, error.what());
  } catch (const MeshError& error) {
    return fail(exit_bad_input, error.what());
  } catch (const ResourceError& error) {
    return fail(exit_resources, error.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_resources, "out of memory");
  } catch (const std::system_error& error) {
    return fail(exit_resources, error.what());
  }
}

}  // namespace touchmark::bench
