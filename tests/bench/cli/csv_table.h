/// A CSV that a command left, as rows of fields. No field of these files needs quotes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "tests/bench/cli/child_program.h"

namespace touchmark::bench::cli {

inline std::vector<std::vector<std::string>> table_in(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(content_of(path));
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream fields(line + ",");
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
  }
  return rows;
}

inline std::size_t index_of(const std::string& column, const std::vector<std::string>& columns) {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) - columns.begin());
}

}  // namespace touchmark::bench::cli
