/// The touchmark program without its main function: parses the command line, runs the command, turns what
/// went wrong into one line on stderr and an exit status.
#pragma once

#include "bench/contestants/contestant_info.h"
#include "bench/support/failures.h"

namespace CLI {
class App;
}

namespace touchmark::bench::cli {

/// What commands share. A command sets `status` when it is not exit_done; errors are thrown.
struct ProgramContext {
  const contestants::Roster& roster;
  int argc = 0;
  char** argv = nullptr;
  int status = support::exit_done;
};

/// The usual way to write a command: `add_NAME(program, context)` adds a subcommand with its options and a
/// final_callback that runs it. The list of them is in program.cpp.
void add_bench(CLI::App& program, ProgramContext& context);
void add_verify(CLI::App& program, ProgramContext& context);
void add_stress(CLI::App& program, ProgramContext& context);
void add_scale(CLI::App& program, ProgramContext& context);
void add_servo(CLI::App& program, ProgramContext& context);
void add_choose(CLI::App& program, ProgramContext& context);
void add_update(CLI::App& program, ProgramContext& context);
void add_proxy(CLI::App& program, ProgramContext& context);
void add_many(CLI::App& program, ProgramContext& context);
void add_list(CLI::App& program, ProgramContext& context);
void add_mesh(CLI::App& program, ProgramContext& context);
void add_query(CLI::App& program, ProgramContext& context);
void add_paper(CLI::App& program, ProgramContext& context);
void add_tune(CLI::App& program, ProgramContext& context);
void add_gate(CLI::App& program, ProgramContext& context);
void add_plan(CLI::App& program, ProgramContext& context);
void add_run(CLI::App& program, ProgramContext& context);
void add_merge(CLI::App& program, ProgramContext& context);
void add_validate(CLI::App& program, ProgramContext& context);

int run_program(int argc, char** argv, const contestants::Roster& roster);

}  // namespace touchmark::bench::cli
