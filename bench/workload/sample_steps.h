/// Which steps of a trajectory are replayed: all of them, or, where a contestant is too slow for that, short
/// stretches of neighbouring steps spread over the whole of it. Depends on nothing but the two counts.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/workload/steps.h"

namespace touchmark::bench::workload {

/// Disjoint ranges, ascending, of about `wanted` steps in all (at least 1; all `total` if wanted >= total).
std::vector<StepRange> sample_steps(std::size_t total, std::size_t wanted);

/// Returns which of the ranges' steps this is, one after the other; it is one of them.
std::size_t place_in(const std::vector<StepRange>& ranges, std::size_t step);
/// Returns the step at such a place, which is below steps_in(ranges).
std::size_t step_at(const std::vector<StepRange>& ranges, std::size_t place);

/// Joins ranges that meet.
std::vector<StepRange> joined(const std::vector<StepRange>& ranges);

/// The range in so many parts, as equal as can be; not more than it has steps.
std::vector<StepRange> split(StepRange range, std::size_t parts);

std::size_t steps_in(const std::vector<StepRange>& ranges) noexcept;

}  // namespace touchmark::bench::workload
