/// Runs the program as a user does.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bench/cli/child_program.h"

namespace touchmark::bench::cli {

/// `output` is where standard output goes instead of Outcome::out.
inline Outcome run_touchmark(const std::vector<std::string>& arguments, const std::string& output = "") {
  std::vector<std::string> command{TOUCHMARK_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_program_at(command, output);
}

/// Bad input: status 2, nothing on standard output, and one line on standard error that names each of
/// `named`.
inline void expect_bad_input(const std::vector<std::string>& arguments,
                             const std::vector<std::string>& named) {
  const Outcome outcome = run_touchmark(arguments);
  std::string command;
  for (const std::string& argument : arguments) command += argument + " ";
  EXPECT_EQ(outcome.status, 2) << command << "\n" << outcome.err;
  EXPECT_EQ(outcome.out, "") << command;
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << command << "\n" << outcome.err;
  for (const std::string& word : named) {
    EXPECT_NE(outcome.err.find(word), std::string::npos) << command << "\n"
                                                         << outcome.err << "does not name " << word;
  }
}

}  // namespace touchmark::bench::cli
