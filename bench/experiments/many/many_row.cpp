#include "bench/experiments/many/many_row.h"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "bench/results/column.h"
#include "bench/support/grouping.h"
#include "bench/support/table.h"

namespace touchmark::bench::experiments::many {
namespace {

using Row = const ManyRow&;
using R = ManyRow;

constexpr std::array<std::pair<AskOrder, std::string_view>, 3> orders{
    {{AskOrder::automatic, "automatic"}, {AskOrder::as_given, "as-given"}, {AskOrder::curve, "curve"}}};

template <auto Member>
std::string plain(Row row) {
  return fmt::format("{}", row.*Member);
}
std::string ratio(Row row) { return row.embree_ratio ? fmt::format("{:.4g}", *row.embree_ratio) : ""; }
std::string points_per_second(Row row) { return fmt::format("{:.4g}", 1e9 / row.ns_per_point); }
std::string us_per_call(Row row) {
  return fmt::format("{:.4g}", row.ns_per_point * 1e-3 * static_cast<double>(row.points));
}

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<R>>({
    {"schema", [](Row) { return std::to_string(many_schema); }},
    {"detector", plain<&R::detector>},
    {"options", plain<&R::options>},
    {"mesh", plain<&R::mesh>},
    {"triangles", plain<&R::triangles>},
    {"kind", plain<&R::kind>},
    {"points", plain<&R::points>},
    {"calls", plain<&R::calls>},
    {"reach", plain<&R::reach>},
    {"threads", plain<&R::threads>},
    {"order", [](Row row) { return std::string(name_of(row.order)); }},
    {"rounds", plain<&R::rounds>},
    {"points_per_second", points_per_second},
    {"ns_per_point", [](Row row) { return fmt::format("{:.4g}", row.ns_per_point); }},
    {"us_per_call", us_per_call},
    {"embree_time_over_this", ratio},
    {"answered", plain<&R::answered>},
    {"differing", plain<&R::differing>},
    {"status", plain<&R::status>},
});

}  // namespace

std::string_view name_of(AskOrder order) noexcept {
  for (const auto& [one, name] : orders)
    if (one == order) return name;
  return "";
}

std::optional<AskOrder> order_named(std::string_view text) noexcept {
  for (const auto& [order, name] : orders)
    if (name == text) return order;
  return std::nullopt;
}

std::string many_csv(const std::vector<ManyRow>& rows) { return results::table_of(columns, rows).csv(); }

std::string many_table(const std::vector<ManyRow>& rows) {
  std::string text;
  for (const auto& [kind, of_kind] : support::grouped_by(rows, [](Row row) { return row.kind; })) {
    const ManyRow& first = *of_kind.front();
    support::Table table({"detector", "threads", "order", "points/s", "ns/point", "us/call",
                          "Embree's time /", "in reach", "status"});
    for (const ManyRow* row : of_kind)
      table.add({row->contestant(), std::to_string(row->threads), std::string(name_of(row->order)),
                 points_per_second(*row), fmt::format("{:.4g}", row->ns_per_point), us_per_call(*row),
                 ratio(*row), std::to_string(row->answered), row->status});
    text += fmt::format("\n{}, {}: {} calls of {} points within {:.4g}\n{}", first.mesh, kind, first.calls,
                        first.points, first.reach, table.text());
  }
  return text;
}

}  // namespace touchmark::bench::experiments::many
