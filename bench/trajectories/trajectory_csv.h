/// Recorded trajectories as CSV files.
#pragma once

#include <cstddef>
#include <string>

#include "bench/trajectories/motion_options.h"
#include "bench/trajectories/trajectory.h"

namespace touchmark::bench::trajectories {

/// A header that names the columns (bench/trajectories/motion_columns.h says how, or `options` do), then one
/// row a tick. Commas, semicolons or tabs separate; beside semicolons and tabs numbers may have decimal
/// commas. Quoted fields, CRLF, a UTF-8 byte-order mark, comment lines (#, %, //), a first line "sep=;",
/// empty rows and a missing last newline are accepted. At most `most` steps are kept, 0 means all. The
/// trajectory's name is the path.
///
/// Coordinates and the file's radii are multiplied with options.scale. Times must ascend. With
/// options.rate_hz the steps are the ticks of a clock of that rate, between rows by linear interpolation;
/// without it rows are steps, and times must be evenly spaced: none more than one and a half times the usual
/// interval after the one before.
///
/// Throws std::invalid_argument, naming the file, line and column, for anything that is not a finite number,
/// a negative radius, a row of another length than the header, no row at all, and times that are not as said.
Trajectory read_trajectory(const std::string& path, std::size_t most = 0, const MotionOptions& options = {});

}  // namespace touchmark::bench::trajectories
