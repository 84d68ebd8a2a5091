#include "bench/experiments/papers/table.h"

#include <stdexcept>

#include <fmt/format.h>

#include "bench/results/column.h"

namespace touchmark::bench::experiments::papers {
namespace {

std::string markdown_line(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

}  // namespace

void Table::add(std::vector<std::string> row) {
  if (row.size() != header_.size())
    throw std::invalid_argument(fmt::format("a row of {} under {} columns", row.size(), header_.size()));
  rows_.push_back(std::move(row));
}

std::string Table::csv() const {
  std::string text = results::csv_line(header_);
  for (const std::vector<std::string>& row : rows_) text += results::csv_line(row);
  return text;
}

std::string Table::markdown() const {
  std::string text = markdown_line(header_);
  text += markdown_line(std::vector<std::string>(header_.size(), "---"));
  for (const std::vector<std::string>& row : rows_) text += markdown_line(row);
  return text;
}

}  // namespace touchmark::bench::experiments::papers
