/// What a command left in a CSV file, by the names of columns.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "bench/support/files/csv_reader.h"

namespace touchmark::bench::cli {

using Fields = std::vector<std::string>;

/// Each record's fields of these columns, which must be there.
inline std::vector<Fields> fields_in(const std::string& path, const Fields& columns) {
  support::CsvReader reader(path);
  Fields header, fields;
  reader.next(header);
  std::vector<Fields> records;
  while (reader.next(fields)) {
    Fields& record = records.emplace_back();
    for (const std::string& column : columns) {
      const auto at = std::find(header.begin(), header.end(), column) - header.begin();
      record.push_back(fields.at(static_cast<std::size_t>(at)));
    }
  }
  return records;
}

}  // namespace touchmark::bench::cli
