#include "bench/workers/timing/eviction.h"

#include <algorithm>

#include <unistd.h>

#include "bench/support/system/available_memory.h"
#include "bench/workers/shared_workload.h"

namespace touchmark::bench::workers {
namespace {

constexpr std::size_t bytes_a_line = 64;

}  // namespace

std::uint64_t EvictionBuffer::walk() noexcept {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < memory_.size(); i += bytes_a_line)
    sum += static_cast<std::uint64_t>(memory_[i]);
  return sum;
}

EvictionSizes eviction_sizes(std::size_t second_level_cache, std::size_t last_level_cache, std::size_t most) {
  constexpr std::size_t megabyte = 1U << 20U;
  const std::size_t second = second_level_cache > 0 ? second_level_cache : megabyte;
  const std::size_t last = last_level_cache > 0 ? last_level_cache : 32 * megabyte;
  return {std::min(2 * second, most), std::min(2 * std::max(last, second), most)};
}

EvictionSizes eviction_sizes() {
  const auto size_of = [](int name) { return static_cast<std::size_t>(std::max(sysconf(name), 0L)); };
  static const auto available = support::available_memory();
  return eviction_sizes(size_of(_SC_LEVEL2_CACHE_SIZE), size_of(_SC_LEVEL3_CACHE_SIZE),
                        available ? static_cast<std::size_t>(*available / 8) : std::size_t{1} << 30U);
}

std::size_t steps_to_evict_all() { return 1 + eviction_sizes().all / OutputBuffers::bytes_for(1); }

}  // namespace touchmark::bench::workers
