/// How a command can end other than well, and what the program then exits with. Bad input is
/// std::invalid_argument or MeshError.
#pragma once

#include <stdexcept>

namespace touchmark::bench::support {

enum ExitStatus : int {
  exit_done = 0,
  exit_check_failed = 1,  ///< the command ran, and something it checked is wrong
  exit_bad_input = 2,     ///< std::invalid_argument, MeshError, or the command line itself
  exit_resources = 3,     ///< ResourceError, std::bad_alloc, std::system_error
  exit_inconclusive = 4,  ///< gate: the machine was too noisy to tell
  exit_interrupted = 130  ///< Ctrl-C; what was finished is kept
};

/// Thrown when something outside ran out or broke: the disk is full, no process can be started.
class ResourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Ctrl-C, or a polite request to end.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace touchmark::bench::support
