/// What a command left in a CSV file, by the names of columns.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/support/files/csv_reader.h"

namespace touchmark::bench::cli {

using Fields = std::vector<std::string>;
using Row = std::map<std::string, std::string>;

/// Each record, from column to field.
inline std::vector<Row> rows_of(const std::string& path) {
  support::CsvReader reader(path);
  Fields header, fields;
  reader.next(header);
  std::vector<Row> rows;
  while (reader.next(fields)) {
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < header.size(); ++i) row[header[i]] = fields.at(i);
  }
  return rows;
}

/// Each record's fields of these columns, which must be there.
inline std::vector<Fields> fields_in(const std::string& path, const Fields& columns) {
  std::vector<Fields> records;
  for (const Row& row : rows_of(path)) {
    Fields& record = records.emplace_back();
    for (const std::string& column : columns) record.push_back(row.at(column));
  }
  return records;
}

}  // namespace touchmark::bench::cli
