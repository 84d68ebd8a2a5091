/// Which column of a motion file holds what, and where its rows begin.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/support/files/csv_reader.h"
#include "bench/trajectories/motion_options.h"

namespace touchmark::bench::trajectories {

struct MotionColumn {
  std::size_t index = 0;  ///< from 0
  std::string name;       ///< for messages
};

struct TimeColumn {
  MotionColumn column;
  std::optional<int> decimals;  ///< the unit, as in ChosenTime; nothing if no name states it
};

struct MotionColumns {
  std::array<MotionColumn, 3> position;
  std::optional<MotionColumn> radius;
  std::optional<TimeColumn> time;
  std::optional<TimeColumn> time_rest;  ///< what is added to `time`, which has whole seconds then
  bool guessed_times = false;           ///< the times were recognised by their first values, not chosen
  std::size_t min_count = 0;            ///< columns in all, without empty ones at the end
  std::size_t count = 0;                ///< columns in all
  std::size_t line = 0;                 ///< the header's line, or the first row's
};

/// Reads the next row that holds more than blanks; false at the end.
bool read_row(support::CsvReader& file, std::vector<std::string>& row);
/// Reads the next row of a motion. Refuses one of separators alone where another row follows: it may be a
/// sample that was not recorded. Throws std::invalid_argument.
bool read_next_row(support::CsvReader& file, std::vector<std::string>& row);

/// Reads up to the first row of the motion, which `first_row` gets; it stays empty where there is none.
///
/// With all columns chosen by number the motion begins with the first row that has numbers in them. Else the
/// header comes before it: a row, or a comment line, that names the columns (motion_names.h says how). Rows
/// of words may stand above. A row above that holds more numbers than words is refused, not left out. Without
/// header and chosen times, the first two columns are times if they hold seconds since 1970 and nanoseconds,
/// as `ros2 topic echo --csv` writes them. Throws std::invalid_argument, naming file and line.
MotionColumns read_motion_header(support::CsvReader& file, const std::optional<ChosenColumns>& chosen,
                                 std::vector<std::string>& first_row);

}  // namespace touchmark::bench::trajectories
