#include "bench/regression/gate/baseline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bench/results/column.h"
#include "bench/support/files/csv_reader.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::regression::gate {
namespace {

/// Columns are only ever appended. The last ones may be missing or empty.
constexpr std::array columns{
    "mesh",    "trajectory", "query",     "detector",   "reference", "mesh_fnv1a", "course_fnv1a",
    "steps",   "ratio",      "ratio_low", "ratio_high", "work_mean", "work_max",   "answers_checksum",
    "version", "commit",     "cpu"};
constexpr std::size_t needed_columns = 9;

/// One record by the names of its columns.
class Record {
 public:
  Record(const support::CsvReader& reader, const std::vector<std::string>& header,
         const std::vector<std::string>& fields)
      : reader_(reader), header_(header), fields_(fields) {}

  const std::string& text(const std::string& column) const {
    static const std::string nothing;
    const auto at = static_cast<std::size_t>(std::ranges::find(header_, column) - header_.begin());
    return at < header_.size() ? fields_[at] : nothing;
  }
  bool has(const std::string& column) const { return !text(column).empty(); }

  double ratio(const std::string& column) const {
    const std::optional<double> value = support::parse_number(text(column));
    if (!value || !(*value > 0) || !std::isfinite(*value)) refuse(column, "a number above 0");
    return *value;
  }
  double amount(const std::string& column) const {
    const std::optional<double> value = support::parse_number(text(column));
    if (!value || *value < 0) refuse(column, "a number of 0 or more");
    return *value;
  }
  std::uint64_t count(const std::string& column) const {
    const std::optional<std::uint64_t> value = support::parse_count(text(column));
    if (!value) refuse(column, "a whole number");
    return *value;
  }
  std::uint64_t hash(const std::string& column) const {
    const std::optional<std::uint64_t> value = support::parse_hex(text(column));
    if (!value) refuse(column, "a hexadecimal number");
    return *value;
  }
  [[noreturn]] void refuse(const std::string& column, const char* expected) const {
    throw reader_.error(fmt::format("{} \"{}\" is not {}", column, text(column), expected));
  }

 private:
  const support::CsvReader& reader_;
  const std::vector<std::string>& header_;
  const std::vector<std::string>& fields_;
};

BaselineRow row_of(const Record& record) {
  BaselineRow row;
  row.key = {record.text("mesh"), record.text("trajectory"), record.text("query"), record.text("detector"),
             record.text("reference")};
  row.mesh_hash = record.hash("mesh_fnv1a");
  row.trace_hash = record.hash("course_fnv1a");
  row.steps = record.count("steps");
  if (row.steps == 0) record.refuse("steps", "above 0");
  row.ratio.ratio = row.ratio.low = row.ratio.high = record.ratio("ratio");
  if (record.has("ratio_low")) row.ratio.low = record.ratio("ratio_low");
  if (record.has("ratio_high")) row.ratio.high = record.ratio("ratio_high");
  if (record.has("work_mean"))
    row.work = measurement::WorkResult{record.amount("work_mean"), record.count("work_max"), {}};
  if (record.has("answers_checksum")) row.checksum = record.hash("answers_checksum");
  row.version = record.text("version");
  row.commit = record.text("commit");
  row.cpu = record.text("cpu");
  return row;
}

std::string line_of(const BaselineRow& row) {
  const GateKey& key = row.key;
  return support::csv_line(
      {key.mesh, key.trajectory, key.query, key.detector, key.reference, support::hex(row.mesh_hash),
       support::hex(row.trace_hash), fmt::format("{}", row.steps), fmt::format("{:.6g}", row.ratio.ratio),
       fmt::format("{:.6g}", row.ratio.low), fmt::format("{:.6g}", row.ratio.high),
       row.work ? fmt::format("{}", row.work->mean) : "", row.work ? fmt::format("{}", row.work->max) : "",
       row.checksum ? support::hex(*row.checksum) : "", row.version, row.commit, row.cpu});
}

}  // namespace

Baseline Baseline::read(const std::string& path) {
  support::CsvReader reader(path);
  std::vector<std::string> header, fields;
  reader.next(header);
  for (std::size_t i = 0; i < needed_columns; ++i)
    if (std::ranges::find(header, columns[i]) == header.end())
      throw reader.error(fmt::format("the header has no column {}", columns[i]));
  Baseline baseline;
  while (reader.next(fields)) {
    if (fields.size() != header.size())
      throw reader.error(fmt::format("the line has {} fields, the header {}", fields.size(), header.size()));
    baseline.rows_.push_back(row_of({reader, header, fields}));
  }
  return baseline;
}

const BaselineRow* Baseline::find(const GateKey& key) const noexcept {
  const auto found = std::ranges::find_if(rows_, [&](const BaselineRow& row) { return row.key == key; });
  return found == rows_.end() ? nullptr : &*found;
}

void Baseline::put(BaselineRow row) {
  const auto found =
      std::ranges::find_if(rows_, [&](const BaselineRow& other) { return other.key == row.key; });
  if (found == rows_.end()) {
    rows_.push_back(std::move(row));
  } else {
    *found = std::move(row);
  }
}

std::string Baseline::csv() const {
  std::string text = support::csv_line({columns.begin(), columns.end()});
  for (const BaselineRow& row : rows_) text += line_of(row);
  return text;
}

}  // namespace touchmark::bench::regression::gate
