/// The names in a motion file's header.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/support/files/csv_reader.h"
#include "bench/trajectories/motion_columns.h"

namespace touchmark::bench::trajectories {

/// Finds columns by name: the one whose name is written just so, else the one that differs in capitals,
/// separators of words, a mark % or # before it and a unit in brackets behind it; else the one that has
/// field, header, stamp, pose, position, point, transform or translation before it.
class MotionNames {
 public:
  /// `line` is for messages; `names` are empty if there is no header.
  MotionNames(const support::CsvReader& file, std::vector<std::string> names, std::size_t line);

  /// Throws std::invalid_argument if two columns fit equally well.
  std::optional<MotionColumn> find(std::string_view name) const;
  /// Returns the column of this name or number; throws std::invalid_argument if there is none.
  MotionColumn column(const ColumnChoice& choice) const;
  /// Returns the column with the unit of its choice, else with the unit that its name states.
  TimeColumn time_column(const ChosenTime& choice) const;

  /// Returns the columns of the usual names, or nothing if they are no position. A position is the first of
  /// x,y,z; px,py,pz; posx,...; pos_x,...; position_x,...; hip_x,...; tx,...; p_x,...; t_x,...; p_RS_R_x,...
  /// that is whole. Times are in the first of time, t, timestamp and stamp, with a unit at the end, or in sec
  /// and nanosec; radii in radius. Throws std::invalid_argument for a unit that is none of time.
  std::optional<MotionColumns> usual_columns() const;

 private:
  std::optional<MotionColumn> find_whole(std::string_view name) const;
  std::optional<MotionColumn> find_part(std::string_view name) const;
  std::optional<std::array<MotionColumn, 3>> usual_position() const;
  template <class Fits>
  std::optional<MotionColumn> only(std::string_view name, const Fits& fits) const;
  void find_usual_times(MotionColumns& columns) const;
  std::optional<int> decimals_of(std::string_view name) const;

  const support::CsvReader& file_;
  std::vector<std::string> names_;
  std::vector<std::string> plain_;  // names as they are compared
  std::size_t line_;
};

}  // namespace touchmark::bench::trajectories
