/// A field of a motion file as a number, or as a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bench/support/files/csv_dialect.h"
#include "bench/support/files/csv_reader.h"

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

/// Returns the decimals of the unit (0 for s, 3, 6, 9) in which the value is a time since 1970, from 1990 to
/// 2100; nothing if it is none.
std::optional<int> decimals_of_date(double value) noexcept;

/// Returns the nanoseconds of a time that NumberReader has read, of less than 9e9 s, rounded towards 0. Its
/// unit is 1 s, or 1e-3 s for 3 decimals and so on.
std::int64_t nanoseconds_of(std::string_view number, int decimals);

}  // namespace touchmark::bench::trajectories
