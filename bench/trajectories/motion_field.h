/// A field of a motion file as a number, or as a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bench/support/csv_dialect.h"
#include "bench/support/csv_reader.h"

namespace touchmark::bench::trajectories {

using support::trimmed;

/// What a message shows of a text: enough to recognise it, and nothing that a terminal would obey.
std::string shown(std::string_view text);

/// Says that a field is no number, and why that may be.
std::string no_number(std::string_view field, char separator);

/// Reads numbers with a decimal point, or throughout with a decimal comma where no comma separates columns.
class NumberReader {
 public:
  explicit NumberReader(const support::CsvReader& file) : file_(file) {}

  /// A finite number; throws std::invalid_argument with file, line and column.
  double read(const std::string& field, const std::string& column);

 private:
  const support::CsvReader& file_;
  char decimal_ = 0;  // the first that was seen
};

/// A moment to 1e-18 s, so that times since 1970 can be subtracted without loss.
struct Instant {
  double whole_s = 0;            ///< a whole number
  std::int64_t attoseconds = 0;  ///< less than 1 s, of the sign of the whole
};

/// Returns the decimals of the unit (0 for s, 3, 6, 9) in which the value is a time since 1970, from 1990 to
/// 2100; nothing if it is none.
std::optional<int> decimals_of_date(double value) noexcept;

/// Returns the moment of a number that NumberReader has read. Its unit is 1 s, or 1e-3 s for 3 decimals and
/// so on.
Instant instant_of(std::string_view number, int decimals);

/// Returns the seconds from `start` to `end`, rounded once if they are less than one, else twice.
double seconds_between(const Instant& start, const Instant& end);

}  // namespace touchmark::bench::trajectories
