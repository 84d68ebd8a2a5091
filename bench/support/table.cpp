#include "bench/support/table.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace touchmark::bench::support {

namespace {

/// What would end a cell or begin a tag of HTML.
std::string markdown_cell(const std::string& text) {
  std::string cell;
  for (const char letter : text) {
    if (letter == '|') {
      cell += "\\|";
    } else if (letter == '<') {
      cell += "&lt;";
    } else {
      cell += letter == '\n' ? ' ' : letter;
    }
  }
  return cell;
}

std::string markdown_line(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += fmt::format(" {} |", markdown_cell(cell));
  return line + '\n';
}

}  // namespace

void Table::add(std::vector<std::string> row) {
  if (row.size() != rows_.front().size())
    throw std::invalid_argument(
        fmt::format("a row of {} under {} columns", row.size(), rows_.front().size()));
  rows_.push_back(std::move(row));
}

std::string Table::text() const {
  std::vector<std::size_t> widths(rows_.front().size());
  for (const std::vector<std::string>& row : rows_)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const std::vector<std::string>& row : rows_) {
    std::string line = fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t i = 1; i < row.size(); ++i) line += fmt::format("  {:>{}}", row[i], widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

std::string Table::csv() const {
  std::string text;
  for (const std::vector<std::string>& row : rows_) text += csv_line(row);
  return text;
}

std::string Table::markdown() const {
  std::string text;
  for (const std::vector<std::string>& row : rows_) {
    text += markdown_line(row);
    if (&row == &rows_.front()) text += markdown_line(std::vector<std::string>(row.size(), "---"));
  }
  return text;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char character : text) {
    if (character == '"') quoted += '"';
    quoted += character;
  }
  return quoted + '"';
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) {
    if (&field != &fields.front()) line += ',';
    line += csv_field(field);
  }
  return line + '\n';
}

}  // namespace touchmark::bench::support
