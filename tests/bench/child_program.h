/// Starts a program and lets it run, for tests that send it signals.
#pragma once

#include <string>
#include <vector>

#include <fcntl.h>
#include <signal.h>
#include <sys/types.h>

#include "tests/bench/run_touchmark.h"

namespace touchmark::bench {

class ChildProgram {
 public:
  /// `command[0]` is a path.
  explicit ChildProgram(std::vector<std::string> command) {
    std::vector<char*> argv;
    for (std::string& word : command) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string out = folder_.file("out"), err = folder_.file("err");
    process_ = ::fork();
    if (process_ != 0) return;
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }

  void signal(int number) const { ::kill(process_, number); }

  Outcome wait() const {
    int status = 0;
    ::waitpid(process_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), content_of(folder_.file("out")),
            content_of(folder_.file("err"))};
  }

 private:
  TemporaryFolder folder_;
  pid_t process_ = -1;
};

inline Outcome run_program_at(const std::vector<std::string>& command) {
  return ChildProgram(command).wait();
}

}  // namespace touchmark::bench
