/// Queries with the caches emptied between them, as physics and graphics leave them to a haptic loop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/workers/paced_replay.h"
#include "bench/workers/shared_workload.h"
#include "bench/workers/worker_protocol.h"

namespace touchmark::bench::workers {

/// A buffer that is walked over, a read a line, so that what was in the caches is there no more. All of its
/// pages are touched when it is made; walking over it takes no memory.
class EvictionBuffer {
 public:
  explicit EvictionBuffer(std::size_t bytes);
  /// Returns a number that depends on every line, so that no walk is left out.
  std::uint64_t walk() noexcept;
  std::size_t bytes() const noexcept { return words_.size() * sizeof(std::uint64_t); }

 private:
  std::vector<std::uint64_t> words_;
};

/// How many bytes are walked over to empty the second-level cache, and all caches.
struct EvictionSizes {
  std::size_t second_level = 0, all = 0;
};

/// Returns twice the cache in question: a walk over as much leaves lines where a cache does not replace the
/// oldest. A cache of size 0 is one that the system does not tell: 1 MB and 32 MB are supposed. Neither size
/// is more than `most`.
EvictionSizes eviction_sizes(std::size_t second_level_cache, std::size_t last_level_cache, std::size_t most);
/// By this machine's caches, and at most an eighth of its available memory.
EvictionSizes eviction_sizes();

/// Samples of the ranges' steps, spread evenly. The step before a sample's is answered first, unclocked, so
/// that the session is where it would be; then the caches are emptied.
class ColdReplay final : public contestants::StepPacer {
 public:
  /// At least one step; `records` takes the request's samples.
  ColdReplay(const std::vector<workload::StepRange>& ranges, const request::Cold& request,
             EvictionBuffer* eviction, std::span<TickRecord> records) noexcept;

  std::optional<std::size_t> next() noexcept override;
  void took(std::uint64_t ticks, const workload::Answer& answer, const Work& work) noexcept override;

 private:
  std::size_t step_of_sample() const noexcept;

  const std::vector<workload::StepRange>& ranges_;
  std::size_t steps_;
  std::size_t first_, of_;    // samples before, and in all
  EvictionBuffer* eviction_;  // null: nothing is evicted
  std::span<TickRecord> records_;
  std::size_t sample_ = 0;
  bool led_up_ = false;  // the step before the sample's has been answered
  std::uint64_t walked_ = 0;
};

/// The samples lie in the output buffers as tick records, without latencies.
void run_cold(contestants::Contestant& contestant, const workload::QueryTrace& trace,
              const std::vector<workload::StepRange>& ranges, const request::Cold& request,
              const OutputBuffers& buffers);

}  // namespace touchmark::bench::workers
