/// How a recorded motion is to be read: which columns, in what unit, at what rate.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace touchmark::bench::trajectories {

/// A column by its name in the header, or by its number, from 1.
using ColumnChoice = std::variant<std::string, std::size_t>;

/// A column of times. Its unit is 1 s, or 1e-3 s for 3 decimals and so on; nothing if the key was "time".
struct ChosenTime {
  ColumnChoice column;
  std::optional<int> decimals;
};

/// Columns that were chosen one by one. Of a file whose columns are all chosen by number the header may be
/// missing.
struct ChosenColumns {
  std::array<ColumnChoice, 3> position;
  std::optional<ColumnChoice> radius;
  std::optional<ChosenTime> time;
  std::optional<ChosenTime> time_rest;  ///< what is added to `time`, which has whole seconds then
};

/// How a recording is laid on the surface (bench/trajectories/drape.h).
enum class Drape { contact, free };

struct MotionOptions {
  std::optional<ChosenColumns> columns;  ///< nothing: by the names that motion_columns.h lists
  std::optional<double> scale;           ///< factor on the coordinates and on the file's radii, to mesh units
  std::optional<double> rate_hz;         ///< the rate to which the motion is resampled by its times
  std::optional<Drape> drape;            ///< nothing: the positions are where the file says
  /// The times are those of a scene that moves: rows may lie any time apart, and of a file without times the
  /// rate is that of its rows.
  bool of_a_scene = false;

  bool are_given() const noexcept { return columns || scale.value_or(1) != 1 || rate_hz || drape; }
};

/// "x=COL,y=COL,z=COL" with any of "time=COL" (or time_s, time_ms, time_us, time_ns) and "radius=COL". A key
/// in seconds and another key of times may stand together: their columns are added. Throws
/// std::invalid_argument, naming the option and the value.
ChosenColumns parse_columns(const std::string& text);

/// The options as the command line gives them; empty texts stand for absent options. Throws
/// std::invalid_argument, naming the option and the value.
MotionOptions parse_motion_options(const std::string& columns, const std::string& scale,
                                   const std::string& rate, const std::string& drape = "");

}  // namespace touchmark::bench::trajectories
