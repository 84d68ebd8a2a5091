/// Rows of text under a header: the same table as a CSV file and as Markdown.
#pragma once

#include <string>
#include <vector>

namespace touchmark::bench::experiments::papers {

class Table {
 public:
  explicit Table(std::vector<std::string> header) : header_(std::move(header)) {}

  /// As many cells as the header has (std::invalid_argument otherwise); an empty one is what was not
  /// measured.
  void add(std::vector<std::string> row);
  std::size_t size() const noexcept { return rows_.size(); }

  std::string csv() const;
  std::string markdown() const;

 private:
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace touchmark::bench::experiments::papers
