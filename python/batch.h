/// A batch of questions on several threads, each with a session and a part of the questions that lie one
/// after the other.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "python/fork_safe_lock.h"

namespace touchmark::python {

/// How a batch is run.
struct Effort {
  std::size_t threads = 1;  ///< 0: as many as the machine has processors
  /// Called every tenth of a second or so on the thread that asked; true ends the batch.
  std::function<bool()> is_interrupted;
};

/// Returns how many threads are of use; to start one takes some tens of microseconds.
inline std::size_t thread_count(std::size_t asked, std::size_t points) {
  constexpr std::size_t min_points_a_thread = 256;
  if (asked == 0) asked = std::max(1u, std::thread::hardware_concurrency());
  return std::clamp(asked, std::size_t{1}, std::max(std::size_t{1}, points / min_points_a_thread));
}

/// Calls ask(i, session) for every i below `count`, with sessions that begin_session() returned; false where
/// it was interrupted. Throws what ask threw first. `is_interrupted` may fork, as signal handlers do: then
/// the batch also goes on in the child, which lacks the other threads.
template <class BeginSession, class Ask>
bool for_all(std::size_t count, const BeginSession& begin_session, const Effort& effort, const Ask& ask) {
  constexpr std::size_t looked_at = 64;  // points between two looks at the clock or at `ended`
  constexpr auto pause = std::chrono::milliseconds(100);
  const std::size_t threads = thread_count(effort.threads, count);
  std::atomic<bool> ended = false, interrupted = false;
  std::exception_ptr thrown;
  std::mutex throwing;
  const std::uint64_t forks = ForkSafeLock::forks();
  std::vector<decltype(begin_session())> sessions;
  for (std::size_t thread = 0; thread < threads; ++thread) sessions.push_back(begin_session());
  const auto ask_part = [&](std::size_t thread, bool may_ask) {
    const std::size_t begin = count / threads * thread + std::min(thread, count % threads);
    const std::size_t end = begin + count / threads + (thread < count % threads ? 1 : 0);
    auto asked_at = std::chrono::steady_clock::now();
    for (std::size_t i = begin; i < end; ++i) {
      ask(i, *sessions[thread]);
      if ((i - begin) % looked_at != looked_at - 1) continue;
      if (may_ask && std::chrono::steady_clock::now() - asked_at > pause) {
        if (effort.is_interrupted()) ended = interrupted = true;
        asked_at = std::chrono::steady_clock::now();
      }
      if (ended.load(std::memory_order_relaxed)) return;
    }
  };
  const auto part = [&](std::size_t thread, bool may_ask) {
    try {
      ask_part(thread, may_ask);
    } catch (...) {
      const std::lock_guard locked(throwing);
      if (!thrown) thrown = std::current_exception();
      ended = true;
    }
  };
  {
    std::vector<std::jthread> others;
    std::size_t started = 1;
    try {
      for (; started < threads; ++started) others.emplace_back(part, started, false);
    } catch (
        const std::system_error&) {  // no more threads to be had: this one does what they would have done
    }
    part(0, true);
    if (forks != ForkSafeLock::forks()) {
      for (std::jthread& other : others) other.detach();
      // What they left half-done is done anew. Their sessions may be half-written.
      for (std::size_t thread = started = 1; thread < threads; ++thread) sessions[thread] = begin_session();
    }
    for (; started < threads; ++started) part(started, true);
  }
  if (thrown) std::rethrow_exception(thrown);
  return !interrupted;
}

}  // namespace touchmark::python
