/// What empties the caches between queries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace touchmark::bench::workers {

/// Memory that is walked over, a read a line, so that what was in the caches is there no more. It is
/// another's: memory of one's own takes far longer to get than to walk over.
class EvictionBuffer {
 public:
  /// Touches all of its pages.
  explicit EvictionBuffer(std::span<const std::byte> memory) noexcept : memory_(memory), touched_(walk()) {}
  /// Returns a number that depends on every line, so that no walk is left out.
  std::uint64_t walk() noexcept;

 private:
  std::span<const std::byte> memory_;
  std::uint64_t touched_;
};

/// How many bytes are walked over to empty the second-level cache, and all caches.
struct EvictionSizes {
  std::size_t second_level = 0, all = 0;
};

/// Returns twice the cache in question: a walk over as much leaves lines where a cache does not replace the
/// oldest. A cache of size 0 is one that the system does not tell: 1 MB and 32 MB are supposed. Neither size
/// is more than `most`.
EvictionSizes eviction_sizes(std::size_t second_level_cache, std::size_t last_level_cache, std::size_t most);
/// By this machine's caches, and at most an eighth of the memory that was available at the first call.
EvictionSizes eviction_sizes();
/// Returns how many steps' room in the output buffers has the bytes that empty all caches.
std::size_t steps_to_evict_all();

}  // namespace touchmark::bench::workers
