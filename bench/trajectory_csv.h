/// Trajectories as CSV files: recorded ones come in, generated ones go out.
#pragma once

#include <cstddef>
#include <string>

#include "bench/trajectory.h"

namespace touchmark::bench {

/// A header that names at least x, y and z (optional time_s, radius; any order, other columns ignored), then
/// one row a tick. Quoted fields, CRLF, a byte order mark and a missing last newline are accepted. At most
/// `most` rows are kept, 0 means all. The trajectory's name is the path. Throws std::invalid_argument, naming
/// the file, line and column, for anything that is not a finite number, a negative radius, time that runs
/// backwards, a row of another length than the header, or no row at all.
Trajectory read_trajectory(const std::string& path, std::size_t most = 0);

/// Shortest text that reads back to the same bits. Written whole or not at all; throws std::runtime_error
/// when it cannot be written.
void write_trajectory(const Trajectory& trajectory, const std::string& path);

}  // namespace touchmark::bench
