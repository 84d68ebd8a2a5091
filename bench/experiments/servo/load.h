/// Other work on the other cores, so that a loop is timed as it runs beside physics and graphics.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <thread>
#include <vector>

namespace touchmark::bench::experiments::servo {

/// memory: a buffer far larger than the caches is walked over, again and again. cpu: arithmetic alone.
enum class Load { none, memory, cpu };

std::string_view name_of(Load load) noexcept;
std::optional<Load> load_named(std::string_view name) noexcept;

/// The cores this process may use but `own`.
std::vector<int> other_cores(int own);

/// The bytes that each of so many generators of memory load walks over: four times the last-level cache, at
/// least 64 MB, but for all together at most an eighth of the memory that is available.
std::size_t bytes_to_walk_over(std::size_t generators);

/// A thread a core, from construction to destruction.
class LoadGenerators {
 public:
  /// Each memory load walks over `bytes`. Throws std::system_error where a thread cannot be started.
  LoadGenerators(Load load, const std::vector<int>& cores, std::size_t bytes);

  /// How often all of them together have gone through their buffers or their arithmetic.
  std::uint64_t rounds() const noexcept { return rounds_; }

 private:
  std::atomic<std::uint64_t> rounds_{0}, last_{0};
  std::vector<std::vector<std::uint64_t>> buffers_;
  std::vector<std::jthread> threads_;  // last: they end before what they use
};

}  // namespace touchmark::bench::experiments::servo
