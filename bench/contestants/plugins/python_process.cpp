#include "bench/contestants/plugins/python_process.h"

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

#include "bench/contestants/plugins/python_script.h"

namespace touchmark::bench::contestants {
namespace {

/// The exit status of a child that could not become Python, as shells have it.
constexpr int not_found = 127;

/// In the child: only async-signal-safe calls.
[[noreturn]] void become_python(char* const* argv, int channel, pid_t parent) {
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

PythonProcess::PythonProcess(const std::string& script) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot talk to Python");
  std::array<std::string, 5> words{"python3", "-c", python_script, script, std::to_string(ends[1])};
  std::array<char*, 6> argv{};
  std::ranges::transform(words, argv.begin(), [](std::string& word) { return word.data(); });
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) become_python(argv.data(), ends[1], parent);
  const int error = errno;
  close(ends[1]);
  channel_ = ends[0];
  if (process_ > 0) return;
  close(channel_);
  throw std::system_error(error, std::generic_category(), "cannot start Python");
}

PythonProcess::~PythonProcess() {
  if (process_ > 0) kill(process_, SIGKILL);
  how_it_ended();
  close(channel_);
}

bool PythonProcess::send(const void* data, std::size_t size) const noexcept {
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

bool PythonProcess::receive(void* data, std::size_t size) const noexcept {
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

std::string PythonProcess::how_it_ended() noexcept {
  int status = 0;
  const pid_t process = std::exchange(process_, -1);
  if (process <= 0 || waitpid(process, &status, 0) != process) return "Python has ended";
  if (WIFSIGNALED(status)) return fmt::format("Python was ended by SIG{}", sigabbrev_np(WTERMSIG(status)));
  if (WEXITSTATUS(status) == not_found) return "there is no python3 in PATH, which runs a plug-in in Python";
  return fmt::format("Python has ended with status {}", WEXITSTATUS(status));
}

PythonMessage PythonProcess::ask(const PythonMessage& question,
                                 std::span<const std::span<const std::byte>> data,
                                 std::string& text) noexcept {
  PythonMessage answer;
  bool whole = send(&question, sizeof question);
  for (const std::span<const std::byte> one : data) whole = whole && send(one.data(), one.size());
  whole = whole && receive(&answer, sizeof answer);
  const bool has_text = answer.code == PythonMessage::failed || question.code == PythonMessage::describe;
  if (whole && has_text) {
    text.resize(answer.number);
    whole = receive(text.data(), text.size());
  }
  if (whole) return answer;
  text = how_it_ended();
  answer.code = PythonMessage::failed;
  return answer;
}

}  // namespace touchmark::bench::contestants
