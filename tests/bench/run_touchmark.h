/// Runs the program as a user does.
#pragma once

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/temporary_folder.h"

namespace touchmark::bench {

inline std::string content_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

struct Outcome {
  int status = -1;  ///< exit status, or 128 + signal as a shell says it
  std::string out, err;
};

/// `output` is where standard output goes instead of Outcome::out.
inline Outcome run_touchmark(const std::vector<std::string>& arguments, const std::string& output = "") {
  const TemporaryFolder folder;
  const std::string out = output.empty() ? folder.file("out") : output, err = folder.file("err");
  std::vector<std::string> words{TOUCHMARK_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  Outcome outcome;
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (output.empty()) outcome.out = content_of(out);
  outcome.err = content_of(err);
  return outcome;
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

}  // namespace touchmark::bench
