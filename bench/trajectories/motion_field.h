/// A field of a motion file as a number.
#pragma once

#include <string>
#include <string_view>

#include "bench/support/csv_reader.h"

namespace touchmark::bench::trajectories {

/// Without spaces and tabs at its ends.
std::string_view trimmed(std::string_view text) noexcept;

/// What a message shows of a text: enough to recognise it, and nothing that a terminal would obey.
std::string shown(std::string_view text);

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

}  // namespace touchmark::bench::trajectories
