/// One row of a CSV file while it is checked: its fields by column, and faults that name them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "bench/results/column.h"
#include "bench/results/validation/fault.h"
#include "bench/results/validation/results_check.h"

namespace touchmark::bench::results::validation {

class RowCheck {
 public:
  /// All references must outlive it.
  RowCheck(const CsvTable& table, const CsvRecord& row, Faults& faults)
      : table_(table), row_(row), faults_(faults) {}

  std::string field(const std::string& column) const { return table_.field(row_, column); }
  /// Returns 0 for what is no whole number.
  std::uint64_t count(const std::string& column) const;
  std::optional<double> number(const std::string& column) const;
  /// True if the status is ok.
  bool is_ok() const { return validation::is_ok(table_, row_); }

  void fault(const std::string& column, const std::string& wrong) const;
  void expect(bool right, const std::string& column, const std::string& wrong) const {
    if (!right) fault(column, wrong);
  }
  /// `run` is the run.json beside the file, or null.
  void expect_run_id(const nlohmann::json* run) const;

  /// Checks each field by the rules of its column. `timed`: rows of this file have times.
  template <class Columns>
  void check_fields(const Columns& columns, bool timed) const {
    for (const auto& column : columns)
      check_field(table_, row_, column.name, column.presence, column.kind, timed, faults_);
  }

 private:
  const CsvTable& table_;
  const CsvRecord& row_;
  Faults& faults_;
};

/// Returns true if the header begins with these columns, at least with `required` of them. Then calls `check`
/// with each row that has as many fields as the header; check_form tells of the others.
template <class Columns, class Check>
bool check_rows(const CsvTable& table, const Columns& columns, std::size_t required, Faults& faults,
                Check check) {
  if (!begins_with_columns(table, names_of(columns), required, faults)) return false;
  for (const CsvRecord& record : table.records)
    if (record.fields.size() == table.header.size()) check(RowCheck(table, record, faults));
  return true;
}

}  // namespace touchmark::bench::results::validation
