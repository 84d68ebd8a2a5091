/// The touchmark program without its main function: parses the command line, runs the command, turns what
/// went wrong into one line on stderr and an exit status.
#pragma once

#include <span>
#include <string_view>

#include "bench/contestants/roster.h"
#include "bench/support/failures.h"

namespace CLI {
class App;
}

namespace touchmark::bench::cli {

struct ProgramContext;
struct SuiteOptions;

/// Adds a subcommand with its options and a final_callback that runs it.
using AddCommand = void (*)(CLI::App& program, ProgramContext& context);

struct Command {
  std::string_view name;
  AddCommand add;
};

/// What a program can do itself. touchmark-extra does the rest: what `scripts/bench` never runs.
struct ProgramParts {
  std::span<const Command> commands;
  /// Runs `bench --suite` and returns an exit status; null: touchmark-extra does.
  int (*run_suite)(const ProgramContext& context, const SuiteOptions& options) = nullptr;
};

/// What commands share. A command sets `status` when it is not exit_done; errors are thrown.
struct ProgramContext {
  contestants::Roster roster;  ///< plug-ins are added to it
  int argc = 0;
  char** argv = nullptr;
  ProgramParts parts;
  int status = support::exit_done;
};

void add_bench(CLI::App& program, ProgramContext& context);
void add_list(CLI::App& program, ProgramContext& context);
void add_mesh(CLI::App& program, ProgramContext& context);
void add_query(CLI::App& program, ProgramContext& context);
void add_verify(CLI::App& program, ProgramContext& context);
void add_new_plugin(CLI::App& program, ProgramContext& context);

/// The commands above.
std::span<const Command> main_commands();

/// Adds a command by its name in the list of all commands, which holds its line of the help.
CLI::App* add_command(CLI::App& program, std::string_view name);

/// Runs the same command line in touchmark-extra. Throws std::invalid_argument if that is not built.
[[noreturn]] void continue_in_extra_program(const ProgramContext& context);

int run_program(int argc, char** argv, const contestants::Roster& roster, const ProgramParts& parts);

}  // namespace touchmark::bench::cli
