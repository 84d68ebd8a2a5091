/// Columns of text, aligned.
#pragma once

#include <string>
#include <vector>

namespace touchmark::bench::support {

class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}

  /// As many cells as the header has.
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// One line a row, two blanks between columns; the first column to the left, the others to the right.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace touchmark::bench::support
