/// Checks that a file is a results.csv of schema 1, and agrees with itself and with its run.json.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/results/column.h"
#include "bench/results/validation/fault.h"

namespace touchmark::bench::results::validation {

struct CsvRecord {
  std::size_t line = 0;
  std::vector<std::string> fields;
};

struct CsvTable {
  std::string path;
  std::vector<std::string> header;
  std::vector<CsvRecord> records;

  bool has(const std::string& column) const;
  /// The field of that column; empty when there is no such column or the record is too short.
  std::string field(const CsvRecord& record, const std::string& column) const;
};

/// Reads a whole file. A file that is not CSV gives what comes before the fault. Throws std::invalid_argument
/// when it cannot be opened.
CsvTable read_csv_table(const std::string& path, Faults& faults);

/// Returns true if the header begins with these names, as far as it goes, and at least with so many of them.
/// The first that is another becomes a fault.
bool begins_with_columns(const CsvTable& table, const std::vector<std::string>& names, std::size_t at_least,
                         Faults& faults);

bool is_ok(const CsvTable& table, const CsvRecord& record);

/// Checks one field by the rules of its column, unless the file ends before that column. `timed`: rows of
/// this file have times.
void check_field(const CsvTable& table, const CsvRecord& record, std::string_view column, Presence presence,
                 const Kind& kind, bool timed, Faults& faults);

/// Any CSV file: a header of different names, and as many fields in each record.
void check_form(const CsvTable& table, Faults& faults);

/// `run` is the run.json beside the file, if there is one.
void check_results(const CsvTable& table, const nlohmann::json* run, Faults& faults);

}  // namespace touchmark::bench::results::validation
