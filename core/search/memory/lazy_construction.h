/// Lazy construction: the first query that misses a part of a constant structure builds it, while others
/// read.
///
/// A reader finds the part either unbuilt, and answers without it, or built; where nothing can stand in for
/// it (bvh/build/lazy_builder.h), it waits. So answers never depend on who came first, and nothing
/// takes memory.
#pragma once

#include <atomic>
#include <cstdint>

namespace touchmark {

/// A number that any thread may read and set at any time, also through a constant. A copy takes it as it is
/// then. To assign, be alone.
template <class T>
class SharedValue {
 public:
  SharedValue(T value = {}) noexcept : value_(value) {}
  SharedValue(const SharedValue& other) noexcept : value_(other.load()) {}
  SharedValue& operator=(const SharedValue& other) noexcept {
    value_.store(other.load(), std::memory_order_relaxed);
    return *this;
  }
  ~SharedValue() = default;

  T load(std::memory_order order = std::memory_order_relaxed) const noexcept { return value_.load(order); }
  void store(T value, std::memory_order order = std::memory_order_relaxed) const noexcept {
    value_.store(value, order);
  }
  /// Adds to the number and returns what it was.
  T add(T more) const noexcept { return value_.fetch_add(more, std::memory_order_relaxed); }
  /// Takes bits off.
  void clear(T bits) const noexcept { value_.fetch_and(static_cast<T>(~bits), std::memory_order_relaxed); }
  /// Replaces the number if it is the one expected. Returns true if it was.
  bool replace(T expected, T desired) const noexcept {
    return value_.compare_exchange_strong(expected, desired, std::memory_order_relaxed);
  }

 private:
  mutable std::atomic<T> value_;
};

/// How far the construction of a part is: one thread claims it, builds it and finishes it. The copy of a part
/// that is under construction is unbuilt.
///
/// The child of a fork lacks the other threads of its parent, and would wait for what they have claimed. So
/// it calls `void_claims` before its first query, as the Python module does.
class LazyState {
 public:
  /// Is built at once.
  LazyState() = default;
  static LazyState unbuilt() noexcept { return LazyState(unbuilt_state); }
  LazyState(const LazyState& other) noexcept : state_(other.is_built() ? built_state : unbuilt_state) {}
  LazyState& operator=(const LazyState& other) noexcept = default;
  ~LazyState() = default;

  bool is_unbuilt() const noexcept { return state_.load() == unbuilt_state; }
  /// Whoever sees this sees all that was written before `finish`.
  bool is_built() const noexcept { return state_.load(std::memory_order_acquire) == built_state; }
  /// True if the caller has to build the part, and to finish it. Where the part was claimed before a fork, it
  /// may be half-written.
  bool claim() const noexcept {
    const State seen = state_.load();
    return seen != built_state && seen != claim_of_this_process &&
           state_.replace(seen, claim_of_this_process);
  }
  void finish() const noexcept { state_.store(built_state, std::memory_order_release); }

  /// Lets all parts be claimed again that are claimed and not built. No other thread may use any meanwhile.
  static void void_claims() noexcept {
    claim_of_this_process = static_cast<State>(claim_of_this_process + 1);
    if (claim_of_this_process < first_claim) claim_of_this_process = first_claim;
  }

 private:
  /// All other states are claims. A process and its parent have different ones.
  using State = std::uint8_t;
  static constexpr State built_state = 0, unbuilt_state = 1, first_claim = 2;
  explicit LazyState(State state) noexcept : state_(state) {}

  static inline State claim_of_this_process = first_claim;
  SharedValue<State> state_ = built_state;
};

}  // namespace touchmark
