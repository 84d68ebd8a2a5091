/// A lock of readers and changes that the child of a fork can use, whatever other threads of its parent did.
#pragma once

#include <cstddef>
#include <cstdint>

namespace touchmark::python {

/// Any number of threads may hold it shared, or one alone, to change what it guards; for std::shared_lock and
/// std::unique_lock. A fork waits for those who hold a lock alone, so its child finds everything whole.
/// There, locks are free but for what the thread that forked holds shared.
///
/// Whoever holds one alone must not wait for the interpreter's lock, which the thread that forks may have.
/// Those who wait take turns: threads that want a lock shared wait for a change that came before them, unless
/// they hold it already, and the next change waits for them.
class ForkSafeLock {
 public:
  ForkSafeLock() = default;
  ForkSafeLock(const ForkSafeLock&) = delete;
  ForkSafeLock& operator=(const ForkSafeLock&) = delete;
  ~ForkSafeLock() = default;

  void lock();
  void unlock();
  void lock_shared();
  bool try_lock_shared();
  void unlock_shared();

  /// Makes forks from now on wait. Throws std::system_error where the system refuses.
  static void follow_forks();
  /// Returns how many forks lie between this process and the one that began to count.
  static std::uint64_t forks() noexcept;

 private:
  struct State {
    std::size_t shared = 0;   ///< how often it is held shared
    bool alone = false;       ///< true: it is held alone
    std::size_t changes = 0;  ///< how many threads wait to hold it alone
    std::size_t readers = 0;  ///< how many threads wait to hold it shared
    std::size_t turns = 0;    ///< so many of them go before the next change
  };
  /// Returns the state in this process.
  State& state() noexcept;
  bool is_open_to_reader(bool holds_it) noexcept;
  static void in_child();

  State state_;
  std::uint64_t forks_ = 0;  ///< what forks() was when the state was set
};

}  // namespace touchmark::python
