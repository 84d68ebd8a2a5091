/// Rows of text under a header: aligned, as a CSV file, or as Markdown.
#pragma once

#include <string>
#include <vector>

namespace touchmark::bench::support {

class Table {
 public:
  explicit Table(std::vector<std::string> header) : rows_{std::move(header)} {}

  /// As many cells as the header has (std::invalid_argument otherwise); an empty one is what was not
  /// measured.
  void add(std::vector<std::string> row);
  /// How many rows there are under the header.
  std::size_t size() const noexcept { return rows_.size() - 1; }

  /// One line a row, two blanks between columns; the first column to the left, the others to the right.
  std::string text() const;
  std::string csv() const;
  std::string markdown() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// One field of a CSV file, in quotes if it needs them, as RFC 4180 has it.
std::string csv_field(const std::string& text);

/// One line of a CSV file, ended by a line feed.
std::string csv_line(const std::vector<std::string>& fields);

}  // namespace touchmark::bench::support
