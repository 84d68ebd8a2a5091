#include "bench/workers/timing/real_time.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include <fmt/format.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "bench/support/system/available_memory.h"

namespace touchmark::bench::workers {
namespace {

constexpr std::uint64_t megabyte = 1U << 20U;

/// True if this user may take the highest priority that is wanted without a limit, or lock all memory.
bool has_capability(int capability) {
  std::ifstream status("/proc/self/status");
  constexpr std::string_view label = "CapEff:";
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(label))
      return (std::strtoull(line.c_str() + label.size(), nullptr, 16) >> static_cast<unsigned>(capability) &
              1U) != 0;
  return false;
}

int allowed_priority() {
  if (has_capability(CAP_SYS_NICE)) return max_real_time_priority;
  rlimit limit{};
  if (getrlimit(RLIMIT_RTPRIO, &limit) != 0) return 0;
  return static_cast<int>(std::min<rlim_t>(limit.rlim_cur, max_real_time_priority));
}

std::optional<std::uint64_t> number_in(const std::string& path) {
  std::uint64_t value = 0;
  if (std::ifstream(path) >> value) return value;
  return std::nullopt;
}

/// What the control group of this process still admits; nothing where it has no limit or cannot be read.
std::optional<std::uint64_t> left_in_control_group() {
  std::ifstream groups("/proc/self/cgroup");
  std::optional<std::uint64_t> least;
  for (std::string line; std::getline(groups, line);) {
    const std::size_t path = line.find(':', line.find(':') + 1);
    if (path == std::string::npos) continue;
    const bool unified = line.starts_with("0::"), memory = line.find(":memory:") != std::string::npos;
    if (!unified && !memory) continue;
    const std::string folder =
        (memory ? "/sys/fs/cgroup/memory" : "/sys/fs/cgroup") + line.substr(path + 1) + '/';
    const auto limit = number_in(folder + (memory ? "memory.limit_in_bytes" : "memory.max"));
    const auto used = number_in(folder + (memory ? "memory.usage_in_bytes" : "memory.current"));
    if (!limit || !used) continue;
    const std::uint64_t left = *limit > *used ? *limit - *used : 0;
    least = least ? std::min(*least, left) : left;
  }
  return least;
}

}  // namespace

RealTimeScope::RealTimeScope(double watchdog_s) {
  prctl(PR_SET_TIMERSLACK, 1);  // a nanosecond; else others than SCHED_FIFO wake up 50 us late
  const int priority = allowed_priority();
  if (priority < 1) {
    scheduler_ = "SCHED_OTHER: SCHED_FIFO is not allowed (ulimit -r)";
    return;
  }
  rlimit limit{};
  if (getrlimit(RLIMIT_RTTIME, &limit) == 0) {
    limit_before_ = limit;
    limit.rlim_cur = std::min<rlim_t>(static_cast<rlim_t>(watchdog_s * 1e6), limit.rlim_max);
    setrlimit(RLIMIT_RTTIME, &limit);
  }
  sched_param parameters{};
  parameters.sched_priority = priority;
  fifo_ = sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
  scheduler_ = fifo_ ? fmt::format("SCHED_FIFO {}", priority)
                     : fmt::format("SCHED_OTHER: SCHED_FIFO is refused ({})", std::strerror(errno));
}

RealTimeScope::~RealTimeScope() {
  const sched_param none{};
  if (fifo_) sched_setscheduler(0, SCHED_OTHER, &none);
  if (limit_before_) setrlimit(RLIMIT_RTTIME, &*limit_before_);
}

MemoryToLock memory_to_lock() {
  MemoryToLock memory;
  std::uint64_t mapped = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> mapped >> resident;
  const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  memory.mapped = mapped * page;
  memory.resident = resident * page;
  rlimit limit{};
  if (!has_capability(CAP_IPC_LOCK) && getrlimit(RLIMIT_MEMLOCK, &limit) == 0 &&
      limit.rlim_cur != RLIM_INFINITY)
    memory.limit = limit.rlim_cur;
  memory.available = support::available_memory();
  if (const auto left = left_in_control_group())
    memory.available = std::min(memory.available.value_or(*left), *left);
  return memory;
}

std::string refusal_to_lock(const MemoryToLock& memory) {
  if (memory.limit && memory.mapped > *memory.limit)
    return fmt::format("{} MB are mapped, {} MB may be locked (ulimit -l)", memory.mapped / megabyte,
                       *memory.limit / megabyte);
  const std::uint64_t more = memory.mapped - std::min(memory.resident, memory.mapped);
  if (memory.available && more > *memory.available / 2)
    return fmt::format("it would take {} MB, and {} MB are available", more / megabyte,
                       *memory.available / megabyte);
  return "";
}

std::string lock_memory() {
  const MemoryToLock memory = memory_to_lock();
  const std::string refusal = refusal_to_lock(memory);
  if (!refusal.empty()) return "not locked: " + refusal;
  // Not what comes later: queries take none.
  if (mlockall(MCL_CURRENT) != 0) return fmt::format("not locked: {}", std::strerror(errno));
  return fmt::format("{} MB locked", memory.mapped / megabyte);
}

}  // namespace touchmark::bench::workers
