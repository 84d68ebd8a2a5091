/// Recorded trajectories as CSV files.
#pragma once

#include <cstddef>
#include <string>

#include "bench/trajectories/motion_options.h"
#include "bench/trajectories/trajectory.h"

namespace touchmark::bench::trajectories {

/// Reads a motion file: a header that names the columns (bench/trajectories/motion_columns.h says how, or
/// `options` do), then one row a tick. Commas, tabs, semicolons or blanks separate; where no comma does,
/// numbers may have decimal commas. Quoted fields, lines that end with CRLF or CR, a UTF-8 byte-order mark,
/// comment lines (#, %, //), a first line "sep=;", empty rows and a missing last newline are accepted. At
/// most `most` steps are kept, 0 means all. The trajectory's name is the path.
///
/// Coordinates and the file's radii are multiplied with options.scale. Times must ascend. With
/// options.rate_hz the steps are the ticks of a clock of that rate, between rows by linear interpolation;
/// without it rows are steps, and times must be evenly spaced: none more than one and a half times the usual
/// interval after the one before. Times of a million seconds or more, as since 1970, are counted from the
/// first row, exactly to the nanosecond; for a scene they are not.
///
/// Throws std::invalid_argument, naming the file, line and column, for anything that is not a finite number,
/// a negative radius, a row of another length than the header, no row at all, and times that are not as said.
Trajectory read_trajectory(const std::string& path, std::size_t most = 0, const MotionOptions& options = {});

}  // namespace touchmark::bench::trajectories
