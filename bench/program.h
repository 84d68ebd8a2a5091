/// The touchmark program without its main function: parses the command line, runs the command, turns what
/// went wrong into one line on stderr and an exit status.
#pragma once

#include <stdexcept>

#include "bench/contestant_info.h"

namespace CLI {
class App;
}

namespace touchmark::bench {

/// What the program exits with.
enum ExitStatus : int {
  exit_done = 0,
  exit_check_failed = 1,  ///< the command ran, and something it checked is wrong
  exit_bad_input = 2,     ///< std::invalid_argument, MeshError, or the command line itself
  exit_resources = 3,     ///< ResourceError, std::bad_alloc, std::system_error
  exit_interrupted = 130  ///< Ctrl-C; what was finished is kept
};

/// Something outside ran out or broke: the disk is full, no process can be started.
class ResourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What commands share. A command sets `status` when it is not exit_done; errors are thrown.
struct ProgramContext {
  const Roster& roster;
  int argc = 0;
  char** argv = nullptr;
  int status = exit_done;
};

/// The usual way to write a command: `add_NAME(program, context)` adds a subcommand with its options and a
/// final_callback that runs it. The list of them is in program.cpp.
void add_list(CLI::App& program, ProgramContext& context);

int run_program(int argc, char** argv, const Roster& roster);

}  // namespace touchmark::bench
