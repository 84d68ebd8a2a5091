#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "bench/results/validation/results_check.h"
#include "bench/support/files/csv_reader.h"

namespace touchmark::bench::results::validation {

bool CsvTable::has(const std::string& column) const {
  return std::ranges::find(header, column) != header.end();
}

std::string CsvTable::field(const CsvRecord& record, const std::string& column) const {
  const auto at = static_cast<std::size_t>(std::ranges::find(header, column) - header.begin());
  return at < header.size() && at < record.fields.size() ? record.fields[at] : "";
}

bool begins_with_columns(const CsvTable& table, const std::vector<std::string>& names, std::size_t at_least,
                         Faults& faults) {
  const std::size_t given = table.header.size();
  for (std::size_t i = 0; i < std::max(at_least, std::min(given, names.size())); ++i) {
    const std::string found = i < given ? table.header[i] : "";
    if (found == names[i]) continue;
    faults.push_back(
        {table.path, 1, fmt::format("header, column {}", i + 1), found, fmt::format("is not {}", names[i])});
    return false;
  }
  return true;
}

bool is_ok(const CsvTable& table, const CsvRecord& record) { return table.field(record, "status") == "ok"; }

void check_field(const CsvTable& table, const CsvRecord& record, std::string_view column, Presence presence,
                 const Kind& kind, bool timed, Faults& faults) {
  const std::string name(column), text = table.field(record, name);
  if (!table.has(name)) return;
  const auto fault = [&](const std::string& wrong) {
    faults.push_back({table.path, record.line, name, text, wrong});
  };
  const bool ok = is_ok(table, record);
  const bool of_times = presence == Presence::built || presence == Presence::timed;
  const bool always = presence == Presence::always;
  if (text.empty() && (always || (ok && (presence == Presence::judged || (of_times && timed)))))
    fault(always ? "must not be empty" : "must not be empty where the status is ok");
  if (!text.empty() && presence == Presence::timed && !ok) fault("must be empty where the status is not ok");
  if (!text.empty() && !kind.accepts(text)) fault(fmt::format("is not {}", kind.what));
}

CsvTable read_csv_table(const std::string& path, Faults& faults) {
  CsvTable table{path, {}, {}};
  support::CsvReader reader(path);
  try {
    if (!reader.next(table.header)) faults.push_back({path, 0, "", "", "the file is empty"});
    for (std::vector<std::string> fields; reader.next(fields);)
      table.records.push_back({reader.line(), fields});
  } catch (const std::invalid_argument& error) {
    // It says "path:line: what" itself.
    const std::string text = error.what();
    const std::string known = fmt::format("{}:{}: ", path, reader.line());
    faults.push_back(
        {path, reader.line(), "", "", text.starts_with(known) ? text.substr(known.size()) : text});
  }
  return table;
}

void check_form(const CsvTable& table, Faults& faults) {
  std::set<std::string> names;
  for (const std::string& name : table.header) {
    if (name.empty()) faults.push_back({table.path, 1, "header", name, "is a column without a name"});
    if (!name.empty() && !names.insert(name).second)
      faults.push_back({table.path, 1, "header", name, "is there twice"});
  }
  for (const CsvRecord& record : table.records) {
    if (record.fields.size() == table.header.size()) continue;
    faults.push_back(
        {table.path, record.line, "", "",
         fmt::format("the line has {} fields, the header {}", record.fields.size(), table.header.size())});
  }
}

}  // namespace touchmark::bench::results::validation
