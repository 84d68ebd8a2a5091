/// Which steps of a trajectory a contestant is timed on that is too slow for all of them: short blocks of
/// neighbouring steps, drawn by phase of the motion. All contestants draw from one list, so that the steps of
/// a slower one are among those of a faster one, and a run draws what another one drew.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bench/workload/steps.h"

namespace touchmark::bench::workload {

/// Says where a block's nearest step is. `near` is within 2 % of the mesh's diagonal of touching.
enum class Phase : std::uint8_t { contact, near, free };
inline constexpr std::size_t phase_count = 3;

class SamplePlan {
 public:
  /// Long enough for a session to profit from coherence, short enough to see many parts of the way.
  static constexpr std::size_t block_steps = 32;
  static std::size_t blocks_in(std::size_t steps) noexcept { return (steps + block_steps - 1) / block_steps; }

  /// Plans for `total` steps, with a phase for each of their blocks. Equal arguments give equal plans.
  SamplePlan(std::size_t total, std::vector<Phase> phases, std::uint64_t seed);

  /// Disjoint ranges, ascending, each in one block, of about `wanted` steps in all: about as large a share
  /// of each phase, and at least two blocks of it. One range of all steps where `wanted` is as many.
  std::vector<StepRange> ranges(std::size_t wanted) const;

  std::size_t total() const noexcept { return total_; }
  Phase phase_of(StepRange range) const { return phases_.at(range.begin / block_steps); }
  std::size_t steps_of(Phase phase) const noexcept { return steps_[static_cast<std::size_t>(phase)]; }

 private:
  std::size_t total_;
  std::vector<Phase> phases_;                     ///< a block each
  std::array<std::size_t, phase_count> steps_{};  ///< a phase each
  std::vector<std::size_t> order_;  ///< blocks in an order whose every beginning is a sample by phase
  std::size_t min_ = 0;             ///< blocks at the beginning that no sample goes without
};

/// What a block's phase is told from: its first, middle and last step.
std::vector<std::size_t> telling_steps(std::size_t total);

/// The phases of the blocks of `steps`, from the distances of the telling ones to the surface.
std::vector<Phase> phases_of(std::span<const Step> steps, std::span<const double> telling_distances,
                             double diagonal);

}  // namespace touchmark::bench::workload
