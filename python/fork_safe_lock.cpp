#include "python/fork_safe_lock.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <new>
#include <system_error>
#include <vector>

#include <pthread.h>

#include "core/search/memory/lazy_construction.h"

namespace touchmark::python {
namespace {

/// Guards the states of all locks.
struct Monitor {
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t held_alone = 0;  ///< how many locks are held alone
  std::size_t forks_waiting = 0;
};

// Never destroyed: threads may still wait when the process ends.
Monitor& monitor = *new Monitor;
std::uint64_t forks_so_far = 0;

/// What this thread holds shared, in the order in which it came.
thread_local std::vector<ForkSafeLock*> held;

void before_fork() {
  std::unique_lock lock(monitor.mutex);
  ++monitor.forks_waiting;
  monitor.changed.wait(lock, [] { return monitor.held_alone == 0; });
  --monitor.forks_waiting;
  lock.release();  // until after the fork
}

void in_parent() {
  monitor.mutex.unlock();
  monitor.changed.notify_all();
}

}  // namespace

void ForkSafeLock::in_child() {
  ::new (&monitor) Monitor;  // its mutex belongs to the parent's thread, and others may wait there
  ++forks_so_far;
  LazyState::void_claims();
  for (ForkSafeLock* lock : held) ++lock->state().shared;
}

void ForkSafeLock::follow_forks() {
  static const int error = pthread_atfork(&before_fork, &in_parent, &in_child);
  if (error != 0) throw std::system_error(error, std::generic_category(), "pthread_atfork");
}

std::uint64_t ForkSafeLock::forks() noexcept { return forks_so_far; }

ForkSafeLock::State& ForkSafeLock::state() noexcept {
  if (forks_ != forks_so_far) {
    state_ = {};
    forks_ = forks_so_far;
  }
  return state_;
}

void ForkSafeLock::lock() {
  std::unique_lock locked(monitor.mutex);
  State& now = state();
  ++now.changes;
  monitor.changed.wait(
      locked, [&] { return !now.alone && now.shared == 0 && now.turns == 0 && monitor.forks_waiting == 0; });
  --now.changes;
  now.alone = true;
  ++monitor.held_alone;
}

void ForkSafeLock::unlock() {
  {
    const std::lock_guard locked(monitor.mutex);
    state_.alone = false;
    state_.turns = state_.readers;
    --monitor.held_alone;
  }
  monitor.changed.notify_all();
}

bool ForkSafeLock::is_open_to_reader(bool holds_it) noexcept {
  const State& now = state();
  return !now.alone && (now.changes == 0 || now.turns > 0 || holds_it);
}

void ForkSafeLock::lock_shared() {
  const bool holds_it = std::ranges::find(held, this) != held.end();
  held.push_back(this);
  std::unique_lock locked(monitor.mutex);
  State& now = state();
  ++now.readers;
  monitor.changed.wait(locked, [&] { return is_open_to_reader(holds_it); });
  --now.readers;
  ++now.shared;
  if (now.turns > 0) --now.turns;
}

bool ForkSafeLock::try_lock_shared() {
  const bool holds_it = std::ranges::find(held, this) != held.end();
  held.push_back(this);
  const std::lock_guard locked(monitor.mutex);
  if (!is_open_to_reader(holds_it)) {
    held.pop_back();
    return false;
  }
  ++state().shared;
  return true;
}

void ForkSafeLock::unlock_shared() {
  held.erase(std::ranges::find(held, this));
  {
    const std::lock_guard locked(monitor.mutex);
    if (--state_.shared > 0) return;
  }
  monitor.changed.notify_all();
}

}  // namespace touchmark::python
