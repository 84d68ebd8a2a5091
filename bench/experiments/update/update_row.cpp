#include "bench/experiments/update/update_row.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "bench/measurement/result_row.h"
#include "bench/results/column.h"
#include "bench/support/grouping.h"
#include "bench/support/table.h"

namespace touchmark::bench::experiments::update {
namespace {

using Row = const UpdateRow&;

std::string guarantee(Row row) {
  if (!row.accuracy) return "";
  return std::string(measurement::guarantee_name(row.accuracy->guarantee));
}

using E = oracle::ErrorCounts;
using R = UpdateRow;
using U = workers::Updated;
using results::text, results::rounded;

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<R>>({
    {"schema", [](Row) { return std::to_string(update_schema); }},
    {"detector", text<&R::detector>},
    {"options", text<&R::options>},
    {"mesh", text<&R::mesh>},
    {"triangles", text<&R::triangles>},
    {"vertices", text<&R::vertices>},
    {"share", rounded<6, &R::share>},
    {"moved_vertices", text<&R::moved_vertices>},
    {"guarantee", guarantee},
    {"status", text<&R::status>},
    {"rounds", rounded<6, &R::updated, &U::rounds>},
    {"build_ms", rounded<6, &R::updated, &U::build_ms>},
    {"update_ms", rounded<6, &R::updated, &U::update_ms>},
    {"update_over_build", rounded<6, &R::updated, &U::update_over_build>},
    {"ns_per_query_updated", rounded<6, &R::ns_updated>},
    {"ns_per_query_built", rounded<6, &R::ns_built>},
    {"answers_as_built",
     [](Row row) { return row.answers_as_built ? fmt::format("{:d}", *row.answers_as_built) : ""; }},
    {"judged", text<&R::counts, &E::judged>},
    {"missed", text<&R::counts, &E::missed>},
    {"false_contacts", text<&R::counts, &E::false_contacts>},
    {"wrong_triangle", text<&R::counts, &E::wrong_triangle>},
    {"beyond_bound", text<&R::counts, &E::beyond_bound>},
    {"malformed", text<&R::counts, &E::malformed>},
    {"unresolved", text<&R::counts, &E::unresolved>},
    {"max_distance_error_of_diagonal", text<&R::counts, &E::max_distance_error_of_diagonal>},
});

std::string table_of(const std::vector<const UpdateRow*>& rows, const std::string& mesh) {
  std::vector<std::string> header{"detector", "build ms"};
  for (const auto& [share, _] : support::grouped_by(rows, [](Row row) { return row.share; }))
    header.push_back(fmt::format("{:g} %", 100 * share));
  for (const char* name : {"query then", "missed", "false", "triangle", "off", "status"})
    header.emplace_back(name);
  support::Table table(header);
  for (const auto& [contestant, of_it] :
       support::grouped_by(rows, [](Row row) { return row.contestant(); })) {
    std::vector<std::string> cells{contestant, ""};
    std::optional<double> dearest;
    oracle::ErrorCounts errors;
    std::string status = "ok";
    for (const UpdateRow* row : of_it) {
      if (row->updated) cells[1] = fmt::format("{:.3g}", row->updated->build_ms);
      cells.push_back(row->updated ? fmt::format("{:.3g}", row->updated->update_over_build) : "");
      if (row->counts) errors += *row->counts;
      if (row->status != "ok") status = row->status;
      if (row->ns_updated && row->ns_built)
        dearest = std::max(dearest.value_or(0), *row->ns_updated / std::max(*row->ns_built, 1e-3));
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

std::string update_csv(const std::vector<UpdateRow>& rows) { return results::table_of(columns, rows).csv(); }

std::string update_table(const std::vector<UpdateRow>& rows) {
  std::string text;
  for (const auto& [mesh, of_mesh] : support::grouped_by(rows, [](Row row) { return row.mesh; }))
    text += table_of(of_mesh, mesh);
  return text;
}

}  // namespace touchmark::bench::experiments::update
