/// Which column of a motion file holds what.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/support/csv_reader.h"
#include "bench/trajectories/motion_options.h"

namespace touchmark::bench::trajectories {

struct MotionColumn {
  std::size_t index = 0;  ///< from 0
  std::string name;       ///< for messages
};

struct MotionColumns {
  std::array<MotionColumn, 3> position;
  std::optional<MotionColumn> time, radius;
  double seconds = 1;     ///< what the time's unit is in seconds
  std::size_t count = 0;  ///< columns in all
};

/// Reads the header. Without a choice of columns the position is the first of these that the header names
/// whole: x,y,z; px,py,pz; posx,posy,posz; pos_x,pos_y,pos_z; position_x,position_y,position_z;
/// hip_x,hip_y,hip_z. Times are in time, t, or either with _s, _ms, _us or _ns at its end; radii in radius.
/// Letters may be capitals, and spaces, points and hyphens stand for underscores. The header may be the last
/// comment line before rows of numbers, as numpy writes it. `first_row` gets the first row where it was read
/// to find that out. Throws std::invalid_argument, naming file and line.
MotionColumns read_motion_header(support::CsvReader& file, const std::optional<ChosenColumns>& chosen,
                                 std::vector<std::string>& first_row);

}  // namespace touchmark::bench::trajectories
