/// Queries with the caches emptied between them, as physics and graphics leave them to a haptic loop.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/workers/shared_workload.h"
#include "bench/workers/timing/eviction.h"
#include "bench/workers/timing/paced_replay.h"
#include "bench/workers/worker_protocol.h"

namespace touchmark::bench::workers {

/// A run of the ranges' steps, one after the other as a loop asks them, with the caches emptied before each.
/// The steps before the run are answered first, unclocked, so that the session knows what it would. Runs are
/// spread evenly however many there will be: by multiples of the golden ratio.
class ColdReplay final : public contestants::StepPacer {
 public:
  /// How many steps are answered before the first sample's: more than any list of ours lasts.
  static constexpr std::size_t lead_up = 20;

  /// At least one step. A sample a record; the last step is asked again where the range is too short.
  /// `first_sample` were taken before.
  ColdReplay(const std::vector<workload::StepRange>& ranges, std::size_t first_sample,
             EvictionBuffer* eviction, std::span<TickRecord> records) noexcept;

  std::optional<std::size_t> next() noexcept override;
  void took(std::uint64_t ticks, const workload::Answer& answer, const Work& work) noexcept override;

 private:
  workload::StepRange run_from(std::size_t first_sample) const noexcept;
  std::size_t step_of_sample() const noexcept { return std::min(run_.begin + sample_, run_.end - 1); }

  const std::vector<workload::StepRange>& ranges_;
  std::size_t steps_;
  EvictionBuffer* eviction_;  // null: nothing is evicted
  std::span<TickRecord> records_;
  std::size_t sample_ = 0;
  workload::StepRange run_;
  std::size_t led_up_to_ = 0;  // steps before this are answered
  std::uint64_t walked_ = 0;
};

/// The samples lie in the output buffers as the request says. `memory` is walked over: it has at least as
/// many bytes as the request wants.
ColdSamples run_cold(contestants::Contestant& contestant, const workload::QueryTrace& trace,
                     const std::vector<workload::StepRange>& ranges, const request::Cold& request,
                     const OutputBuffers& buffers, std::span<const std::byte> memory);

}  // namespace touchmark::bench::workers
