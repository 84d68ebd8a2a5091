/// Which steps of a trajectory are replayed: all of them, or, where a contestant is too slow for that, short
/// stretches of neighbouring steps spread over the whole of it. Depends on nothing but the two counts.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/workload/steps.h"

namespace touchmark::bench {

/// Disjoint windows, ascending, of about `wanted` steps in all (at least 1; all `total` if wanted >= total).
std::vector<Window> plan_windows(std::size_t total, std::size_t wanted);

/// Those that meet made one.
std::vector<Window> joined(const std::vector<Window>& windows);

/// The window in so many parts, as equal as can be; not more than it has steps.
std::vector<Window> split(Window window, std::size_t parts);

std::size_t steps_in(const std::vector<Window>& windows) noexcept;

}  // namespace touchmark::bench
