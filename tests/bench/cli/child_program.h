/// Starts a program and lets it run: to its end, or until a test sends it a signal.
#pragma once

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <fcntl.h>
#include <signal.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/temporary_folder.h"

namespace touchmark::bench::cli {

inline std::string content_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

struct Outcome {
  int status = -1;  ///< exit status, or 128 + signal as a shell says it
  std::string out, err;
};

class ChildProgram {
 public:
  /// `command[0]` is a path; `output` is where standard output goes instead of Outcome::out.
  explicit ChildProgram(std::vector<std::string> command, const std::string& output = "") : output_(output) {
    std::vector<char*> argv;
    for (std::string& word : command) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string out = output.empty() ? folder_.file("out") : output, err = folder_.file("err");
    process_ = ::fork();
    if (process_ != 0) return;
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }

  pid_t id() const { return process_; }
  void signal(int number) const { ::kill(process_, number); }

  Outcome wait() const {
    int status = 0;
    ::waitpid(process_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            output_.empty() ? content_of(folder_.file("out")) : "", content_of(folder_.file("err"))};
  }

 private:
  TemporaryFolder folder_;
  std::string output_;
  pid_t process_ = -1;
};

inline Outcome run_program_at(const std::vector<std::string>& command, const std::string& output = "") {
  return ChildProgram(command, output).wait();
}

}  // namespace touchmark::bench::cli
