#include "bench/contestants/plugins/script_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/contestants/plugins/interpreters.h"

namespace touchmark::bench::contestants {
namespace {

/// The exit status of a child that could not become the interpreter, as shells have it.
constexpr int not_found = 127;

/// In the child: only async-signal-safe calls.
[[noreturn]] void become_interpreter(char* const* argv, int channel, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(not_found);
  // Whatever the worker has open is the worker's: its end must be seen by the program at once.
  constexpr int last_looked_at = 256;
  for (int descriptor = STDERR_FILENO + 1; descriptor < last_looked_at; ++descriptor)
    fcntl(descriptor, F_SETFD, descriptor == channel ? 0 : FD_CLOEXEC);
  execvp(argv[0], argv);
  _exit(not_found);
}

}  // namespace

ScriptProcess::ScriptProcess(const Interpreter& interpreter, const std::string& script)
    : interpreter_(interpreter) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw std::system_error(errno, std::generic_category(),
                            std::string("cannot talk to ") + interpreter.name);
  std::array<std::string, 5> words{interpreter.command, interpreter.option, interpreter.program, script,
                                   std::to_string(ends[1])};
  std::array<char*, 6> argv{};
  std::ranges::transform(words, argv.begin(), [](std::string& word) { return word.data(); });
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) become_interpreter(argv.data(), ends[1], parent);
  const int error = errno;
  close(ends[1]);
  channel_ = ends[0];
  if (process_ > 0) return;
  close(channel_);
  throw std::system_error(error, std::generic_category(), std::string("cannot start ") + interpreter.name);
}

ScriptProcess::~ScriptProcess() {
  if (process_ > 0) kill(process_, SIGKILL);
  how_it_ended();
  close(channel_);
}

bool ScriptProcess::send(const void* data, std::size_t size) const noexcept {
  const auto* from = static_cast<const std::byte*>(data);
  while (size > 0) {
    const ssize_t sent = ::send(channel_, from, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    from += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool ScriptProcess::receive(void* data, std::size_t size) const noexcept {
  auto* to = static_cast<std::byte*>(data);
  while (size > 0) {
    const ssize_t got = recv(channel_, to, size, MSG_WAITALL);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

std::string ScriptProcess::how_it_ended() noexcept {
  int status = 0;
  const pid_t process = std::exchange(process_, -1);
  if (process <= 0 || waitpid(process, &status, 0) != process)
    return fmt::format("{} has ended", interpreter_.name);
  if (WIFSIGNALED(status))
    return fmt::format("{} was ended by SIG{}", interpreter_.name, sigabbrev_np(WTERMSIG(status)));
  if (WEXITSTATUS(status) == not_found)
    return fmt::format("there is no {} in PATH, which runs a plug-in in {}: {}", interpreter_.command,
                       interpreter_.language, interpreter_.way_out);
  return fmt::format("{} has ended with status {}", interpreter_.name, WEXITSTATUS(status));
}

ScriptMessage ScriptProcess::ask(const ScriptMessage& question,
                                 std::span<const std::span<const std::byte>> data,
                                 std::string& text) noexcept {
  ScriptMessage answer;
  bool whole = send(&question, sizeof question);
  for (const std::span<const std::byte> one : data) whole = whole && send(one.data(), one.size());
  whole = whole && receive(&answer, sizeof answer);
  const bool has_text = answer.code == ScriptMessage::failed || question.code == ScriptMessage::describe ||
                        question.code == ScriptMessage::reproduce;
  if (whole && has_text) {
    text.resize(answer.number);
    whole = receive(text.data(), text.size());
  }
  if (whole) return answer;
  text = how_it_ended();
  answer.code = ScriptMessage::failed;
  return answer;
}

}  // namespace touchmark::bench::contestants
