/// What a thread asks of the system so that it wakes up in time, as far as it is allowed to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <sys/resource.h>

namespace touchmark::bench::workers {

/// Above most kernel threads' need and below those that keep the machine alive (50 is that of interrupts).
inline constexpr int max_real_time_priority = 50;

/// SCHED_FIFO for the calling thread as long as the object lives, with the kernel as a watchdog: SIGXCPU ends
/// a process that does not sleep for so long. Where it is refused the thread stays as it was.
class RealTimeScope {
 public:
  explicit RealTimeScope(double watchdog_s);
  RealTimeScope(const RealTimeScope&) = delete;
  RealTimeScope& operator=(const RealTimeScope&) = delete;
  ~RealTimeScope();

  /// "SCHED_FIFO 50", or "SCHED_OTHER" and why.
  const std::string& scheduler() const noexcept { return scheduler_; }

 private:
  std::string scheduler_;
  bool fifo_ = false;
  std::optional<rlimit> limit_before_;
};

/// What locking all memory of this process would take, and what there is.
struct MemoryToLock {
  std::uint64_t mapped = 0;                ///< bytes of address space: what mlockall counts
  std::uint64_t resident = 0;              ///< those of them that are in memory already
  std::optional<std::uint64_t> limit;      ///< ulimit -l, bytes; nothing: none, or not for this user
  std::optional<std::uint64_t> available;  ///< the machine's and the control group's; nothing: unknown
};

MemoryToLock memory_to_lock();

/// Says why memory is not to be locked; empty where it may be. Half of what is available stays for others.
std::string refusal_to_lock(const MemoryToLock& memory);

/// Locks what this process has in memory, if nothing speaks against it. Returns "34 MB locked", or "not
/// locked" and why.
std::string lock_memory();

}  // namespace touchmark::bench::workers
