/// Times of a recorded motion: are they a clock's, and where was it at the ticks of another one?
#pragma once

#include <cstddef>

#include "bench/trajectories/trajectory.h"

namespace touchmark::bench::trajectories {

/// The first row that comes more than one and a half times the usual (the median) interval after the row
/// before it: a row is missing there. 0 where there is none.
std::size_t first_gap(const std::vector<double>& times_s);

/// Ticks from the first row to the last at this rate.
double ticks_at(const Trajectory& recorded, double rate_hz);

/// Position and radius at the ticks of a clock of this rate that starts with the first row, by linear
/// interpolation; a tick that is a row's time but for rounding gets just that row. Needs times, which ascend.
/// At most `most` ticks, 0 means all.
Trajectory resampled(const Trajectory& recorded, double rate_hz, std::size_t most);

}  // namespace touchmark::bench::trajectories
