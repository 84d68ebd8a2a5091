#include "bench/support/system/system_limit.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "bench/support/failures.h"

namespace touchmark::bench::support {
namespace {

std::optional<rlim_t> limit_of(decltype(RLIMIT_AS) resource) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur;
}

std::string limited(decltype(RLIMIT_AS) resource, std::string_view what) {
  const std::optional<rlim_t> limit = limit_of(resource);
  return limit ? fmt::format(": no more than {} {}", *limit, what) : "";
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

void end_out_of_time(int /*signal*/) {
  constexpr std::string_view line =
      "touchmark: the processor time that this process may have is used up (ulimit -t)\n";
  const ssize_t ignored = write(STDERR_FILENO, line.data(), line.size());
  static_cast<void>(ignored);
  _exit(exit_resources);
}

}  // namespace

std::string memory_limit() {
  const std::optional<rlim_t> limit = limit_of(RLIMIT_AS);
  return limit ? fmt::format(": no more than {} MB in a process (ulimit -v)", *limit >> 20U) : "";
}

std::string limit_behind(int error) {
  switch (error) {
    case EMFILE:
      return limited(RLIMIT_NOFILE, "open files in a process (ulimit -n)");
    case EAGAIN:
      return limited(RLIMIT_NPROC, "processes and threads of a user (ulimit -u)");
    case ENOMEM:
      return memory_limit();
    case EFBIG:
      return limited(RLIMIT_FSIZE, "bytes in a file (ulimit -f)");
    default:
      return "";
  }
}

std::string described_with_limit(int error) { return std::strerror(error) + limit_behind(error); }

bool used_up_its_time(const rusage& used) {
  constexpr double rounding_s = 0.1;  // the kernel looks at each tick of its own clock
  const std::optional<rlim_t> limit = limit_of(RLIMIT_CPU);
  return limit && seconds(used.ru_utime) + seconds(used.ru_stime) >= static_cast<double>(*limit) - rounding_s;
}

std::string time_limit() {
  return fmt::format("no more than {} s of processor time in a process (ulimit -t)",
                     limit_of(RLIMIT_CPU).value_or(0));
}

void survive_limits() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGXCPU, end_out_of_time);
}

}  // namespace touchmark::bench::support
