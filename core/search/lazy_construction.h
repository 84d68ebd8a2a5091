/// Lazy construction: the first query that misses a part of a constant structure builds it, while others
/// read.
///
/// A reader finds the part either unbuilt, and answers without it, or built; where nothing can stand in for
/// it (sphere_cluster/tree/lazy_builder.h), it waits. So answers never depend on who came first, and nothing
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
class LazyState {
 public:
  /// Is built at once.
  LazyState() = default;
  static LazyState unbuilt() noexcept { return LazyState(State::unbuilt); }
  LazyState(const LazyState& other) noexcept : state_(other.is_built() ? State::built : State::unbuilt) {}
  LazyState& operator=(const LazyState& other) noexcept = default;
  ~LazyState() = default;

  bool is_unbuilt() const noexcept { return state_.load() == State::unbuilt; }
  /// Whoever sees this sees all that was written before `finish`.
  bool is_built() const noexcept { return state_.load(std::memory_order_acquire) == State::built; }
  /// Is it the caller who has to build the part, and to finish it?
  bool claim() const noexcept { return is_unbuilt() && state_.replace(State::unbuilt, State::claimed); }
  void finish() const noexcept { state_.store(State::built, std::memory_order_release); }

 private:
  enum class State : std::uint8_t { built, unbuilt, claimed };
  explicit LazyState(State state) noexcept : state_(state) {}

  SharedValue<State> state_ = State::built;
};

}  // namespace touchmark
