#include "bench/experiments/update/update_row.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "bench/measurement/result_row.h"
#include "bench/results/results_csv.h"
#include "bench/support/text_table.h"

namespace touchmark::bench::experiments::update {
namespace {

struct Column {
  std::string_view name;
  std::string (*value)(const UpdateRow& row);
};

using Row = const UpdateRow&;

std::string rounded(std::optional<double> value) { return value ? fmt::format("{:.6g}", *value) : ""; }

template <auto Member>
std::string of_update(Row row) {
  return row.updated ? fmt::format("{:.6g}", static_cast<double>((*row.updated).*Member)) : "";
}
template <auto Member>
std::string of_counts(Row row) {
  return row.counts ? fmt::format("{}", (*row.counts).*Member) : "";
}

std::string guarantee(Row row) {
  if (!row.accuracy) return "";
  return std::string(measurement::guarantee_name(row.accuracy->guarantee));
}

// The order is the contract. schema comes before these.
constexpr std::array columns{
    Column{"detector", [](Row row) { return row.detector; }},
    Column{"options", [](Row row) { return row.options; }},
    Column{"mesh", [](Row row) { return row.mesh; }},
    Column{"triangles", [](Row row) { return fmt::format("{}", row.triangles); }},
    Column{"vertices", [](Row row) { return fmt::format("{}", row.vertices); }},
    Column{"share", [](Row row) { return fmt::format("{:.6g}", row.share); }},
    Column{"moved_vertices", [](Row row) { return fmt::format("{}", row.moved_vertices); }},
    Column{"guarantee", guarantee},
    Column{"status", [](Row row) { return row.status; }},
    Column{"rounds", of_update<&workers::Updated::rounds>},
    Column{"build_ms", of_update<&workers::Updated::build_ms>},
    Column{"update_ms", of_update<&workers::Updated::update_ms>},
    Column{"update_over_build", of_update<&workers::Updated::update_over_build>},
    Column{"ns_per_query_updated", [](Row row) { return rounded(row.ns_updated); }},
    Column{"ns_per_query_built", [](Row row) { return rounded(row.ns_built); }},
    Column{"answers_as_built",
           [](Row row) {
             return std::string(!row.answers_as_built ? "" : *row.answers_as_built ? "1" : "0");
           }},
    Column{"judged", of_counts<&oracle::ErrorCounts::judged>},
    Column{"missed", of_counts<&oracle::ErrorCounts::missed>},
    Column{"false_contacts", of_counts<&oracle::ErrorCounts::false_contacts>},
    Column{"wrong_triangle", of_counts<&oracle::ErrorCounts::wrong_triangle>},
    Column{"beyond_bound", of_counts<&oracle::ErrorCounts::beyond_bound>},
    Column{"malformed", of_counts<&oracle::ErrorCounts::malformed>},
    Column{"unresolved", of_counts<&oracle::ErrorCounts::unresolved>},
    Column{"max_distance_error_of_diagonal", of_counts<&oracle::ErrorCounts::max_distance_error_of_diagonal>},
};

template <class Values, class Value>
void add_new(Values& values, const Value& value) {
  if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
}

std::string table_of(const std::vector<UpdateRow>& rows, const std::string& mesh) {
  std::vector<double> shares;
  std::vector<std::string> contestants;
  for (const UpdateRow& row : rows) {
    if (row.mesh != mesh) continue;
    add_new(shares, row.share);
    add_new(contestants, row.contestant());
  }
  std::vector<std::string> header{"detector", "build ms"};
  for (const double share : shares) header.push_back(fmt::format("{:g} %", 100 * share));
  for (const char* name : {"query then", "missed", "false", "triangle", "off", "status"})
    header.emplace_back(name);
  support::TextTable table(header);
  for (const std::string& contestant : contestants) {
    std::vector<std::string> cells{contestant, ""};
    std::optional<double> dearest;
    oracle::ErrorCounts errors;
    std::string status = "ok";
    for (const UpdateRow& row : rows) {
      if (row.mesh != mesh || row.contestant() != contestant) continue;
      if (row.updated) cells[1] = fmt::format("{:.3g}", row.updated->build_ms);
      cells.push_back(row.updated ? fmt::format("{:.3g}", row.updated->update_over_build) : "");
      if (row.counts) errors += *row.counts;
      if (row.status != "ok") status = row.status;
      if (row.ns_updated && row.ns_built)
        dearest = std::max(dearest.value_or(0), *row.ns_updated / std::max(*row.ns_built, 1e-3));
    }
    cells.push_back(dearest ? fmt::format("{:.2f}", *dearest) : "");
    for (const std::uint64_t count :
         {errors.missed, errors.false_contacts, errors.wrong_triangle, measurement::answers_off(errors)})
      cells.push_back(status == "ok" ? fmt::format("{}", count) : "");
    cells.push_back(status);
    table.add(std::move(cells));
  }
  return fmt::format(
      "\n{}: an update's time over a build's, by the share of vertices that moved;\n"
      "query then: the dearest after an update over that of a detector built anew\n{}",
      mesh, table.text());
}

}  // namespace

std::string update_csv(const std::vector<UpdateRow>& rows) {
  std::vector<std::string> header{"schema"};
  for (const Column& column : columns) header.emplace_back(column.name);
  std::string csv = results::csv_line(header);
  for (const UpdateRow& row : rows) {
    std::vector<std::string> fields{fmt::format("{}", update_schema)};
    for (const Column& column : columns) fields.push_back(column.value(row));
    csv += results::csv_line(fields);
  }
  return csv;
}

std::string update_table(const std::vector<UpdateRow>& rows) {
  std::vector<std::string> meshes;
  for (const UpdateRow& row : rows) add_new(meshes, row.mesh);
  std::string text;
  for (const std::string& mesh : meshes) text += table_of(rows, mesh);
  return text;
}

}  // namespace touchmark::bench::experiments::update
