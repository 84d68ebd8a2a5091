#include "bench/support/system/own_process.h"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <new>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/support/system/available_memory.h"
#include "bench/support/system/interrupt.h"

namespace touchmark::bench::support {
namespace {

using Clock = std::chrono::steady_clock;

enum ChildStatus : int { child_done = 0, child_out_of_memory = 1, child_cannot_write = 2 };

void limit(decltype(RLIMIT_AS) resource, rlim_t most) {
  rlimit now{};
  if (getrlimit(resource, &now) != 0) return;
  now.rlim_cur = std::min(most, now.rlim_max);
  setrlimit(resource, &now);
}

void limit_memory([[maybe_unused]] std::uint64_t bytes) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  limit(RLIMIT_AS, address_space() + bytes);
#endif
}

[[noreturn]] void run_child(int out, const std::function<void(std::FILE*)>& work,
                            const ProcessLimits& limits) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGINT, SIGTERM, SIGXCPU}) std::signal(signal, SIG_DFL);
  if (const int nowhere = open("/dev/null", O_RDWR); nowhere >= 0)
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  limit(RLIMIT_CORE, 0);
  limit_memory(limits.bytes);
  try {
    std::FILE* const file = fdopen(out, "w");
    work(file);
    _exit(std::fclose(file) == 0 ? child_done : child_cannot_write);
  } catch (const std::bad_alloc&) {
    _exit(child_out_of_memory);
  }
}

/// Ends the process, whatever it does, where nobody has waited for it.
class Child {
 public:
  explicit Child(pid_t process) : process_(process) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (process_ == 0) return;
    kill(process_, SIGKILL);
    wait();
  }

  /// As waitpid tells it.
  int wait() {
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
    process_ = 0;
    return status;
  }

 private:
  pid_t process_;
};

struct Descriptor {
  int number;
  ~Descriptor() { close(number); }
};

std::string read_all(int in, std::chrono::milliseconds time) {
  const Clock::time_point end = Clock::now() + time;
  std::string text, block(1 << 16, '\0');
  for (;;) {
    check_for_interrupt();
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0)
      throw ProcessFailure(fmt::format("took more than {:g} s", std::chrono::duration<double>(time).count()));
    pollfd waiting{in, POLLIN, 0};
    constexpr long between_checks = 100;
    if (poll(&waiting, 1, static_cast<int>(std::min<long>(left.count(), between_checks))) <= 0) continue;
    const ssize_t got = read(in, block.data(), block.size());
    if (got == 0) return text;
    if (got > 0) text.append(block, 0, static_cast<std::size_t>(got));
  }
}

}  // namespace

std::optional<std::string> in_own_process(const std::function<void(std::FILE*)>& work,
                                          const ProcessLimits& limits) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  const Descriptor in{ends[0]};
  const pid_t process = fork();
  if (process == 0) run_child(ends[1], work, limits);
  close(ends[1]);
  if (process < 0) return std::nullopt;
  Child child(process);
  std::string result = read_all(in.number, limits.time);
  const int status = child.wait();
  if (WIFSIGNALED(status)) throw ProcessFailure(fmt::format("crashed ({})", strsignal(WTERMSIG(status))));
  switch (WEXITSTATUS(status)) {
    case child_done:
      return result;
    case child_out_of_memory:
      throw ProcessFailure(
          fmt::format("needed more than {:.1f} GB", static_cast<double>(limits.bytes) / 1e9));
    default:
      throw ProcessFailure(fmt::format("ended with status {}", WEXITSTATUS(status)));
  }
}

}  // namespace touchmark::bench::support
