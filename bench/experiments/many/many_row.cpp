#include "bench/experiments/many/many_row.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/many/many_workload.h"
#include "bench/results/validation/row_check.h"
#include "bench/support/grouping.h"
#include "bench/support/names.h"
#include "bench/support/table.h"

namespace touchmark::bench::experiments::many {
namespace {

using Row = const ManyRow&;
using R = ManyRow;

constexpr std::array<support::Name<AskOrder>, 3> orders{
    {{AskOrder::automatic, "automatic"}, {AskOrder::as_given, "as-given"}, {AskOrder::curve, "curve"}}};

std::string points_per_second(Row row) { return fmt::format("{:.4g}", 1e9 / row.ns_per_point); }
std::string us_per_call(Row row) {
  return fmt::format("{:.4g}", row.ns_per_point * 1e-3 * static_cast<double>(row.points));
}

bool is_kind(std::string_view text) { return kind_named(text).has_value(); }
bool is_order(std::string_view text) { return order_named(text).has_value(); }
bool is_status(std::string_view text) { return text == "ok" || text == "wrong"; }

using results::Presence, results::text, results::rounded;
using results::kinds::any_text, results::kinds::one, results::kinds::positive, results::kinds::positive_count,
    results::kinds::whole_number;
constexpr Presence always = Presence::always, optional = Presence::optional;
constexpr results::Kind kind{is_kind, "one of coherent, incoherent, pointshell, pointshell-close"},
    order{is_order, "one of automatic, as-given, curve"}, status{is_status, "one of ok, wrong"};

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<R>>({
    {"schema", [](Row) { return std::to_string(many_schema); }, always, one, "1."},
    {"detector", text<&R::detector>, always, any_text, "The contestant."},
    {"options", text<&R::options>, optional, any_text, "As results.csv has them."},
    {"mesh", text<&R::mesh>, always, any_text, "The scene or the file's name."},
    {"triangles", text<&R::triangles>, always, positive_count, "How many the mesh has."},
    {"kind", text<&R::kind>, always, kind, "Which points, as `touchmark many --help` explains them."},
    {"points", text<&R::points>, always, positive_count, "How many a call asks of."},
    {"calls", text<&R::calls>, always, positive_count, "One, or as many as a pointshell has ticks."},
    {"reach", text<&R::reach>, always, positive, "Mesh units."},
    {"threads", text<&R::threads>, always, positive_count,
     "How many threads asked, the caller's one of them."},
    {"order", [](Row row) { return std::string(name_of(row.order)); }, always, order,
     "The order of asking: along a curve, as given, or which of them is better."},
    {"rounds", text<&R::rounds>, always, positive_count,
     "All calls once, beginning with nothing known; timed."},
    {"points_per_second", points_per_second, always, positive, "1e9 / `ns_per_point`."},
    {"ns_per_point", rounded<4, &R::ns_per_point>, always, positive,
     "Of all threads together, the median of the rounds; processor time of a single thread."},
    {"us_per_call", us_per_call, always, positive, "`ns_per_point` times `points`."},
    {"embree_time_over_this", rounded<4, &R::embree_ratio>, optional, positive,
     "Embree's time over this one's in the same round, the median of the rounds; above 1 this one is "
     "faster."},
    {"answered", text<&R::answered>, always, whole_number,
     "Points of all calls with something within reach."},
    {"differing", text<&R::differing>, always, whole_number,
     "Answers that are not as `aabb-tree`, asked one by one, has them: to the last bit, or to what is "
     "claimed."},
    {"status", text<&R::status>, always, status, "`wrong` where `differing` is above 0."},
});

namespace validation = results::validation;

/// Numbers are written with four digits.
bool nearly(double a, double b) { return std::abs(a - b) <= 2e-3 * std::abs(b); }

void check_numbers(const validation::RowCheck& row) {
  const double ns = row.number("ns_per_point").value_or(0);
  const std::uint64_t points = row.count("points"), all = points * row.count("calls");
  row.expect(nearly(row.number("points_per_second").value_or(0), 1e9 / ns), "points_per_second",
             "is not 1e9 / ns_per_point");
  row.expect(nearly(row.number("us_per_call").value_or(0), 1e-3 * ns * static_cast<double>(points)),
             "us_per_call", "is not ns_per_point times points");
  row.expect(row.count("answered") <= all, "answered",
             fmt::format("is above the {} points of all calls", all));
  row.expect((row.field("status") == "wrong") == (row.count("differing") > 0), "status",
             "does not go with differing");
}

}  // namespace

std::string_view name_of(AskOrder order) noexcept { return support::name_in(orders, order); }

std::optional<AskOrder> order_named(std::string_view text) noexcept {
  return support::value_in<AskOrder>(orders, text);
}

std::span<const results::Column<ManyRow>> many_columns() { return columns; }

std::string many_csv(const std::vector<ManyRow>& rows) { return results::table_of(columns, rows).csv(); }

std::string many_table(const std::vector<ManyRow>& rows) {
  std::string text;
  for (const auto& [kind, of_kind] : support::grouped_by(rows, [](Row row) { return row.kind; })) {
    const ManyRow& first = *of_kind.front();
    support::Table table({"detector", "threads", "order", "points/s", "ns/point", "us/call",
                          "Embree's time /", "in reach", "status"});
    for (const ManyRow* row : of_kind)
      table.add({row->contestant(), std::to_string(row->threads), std::string(name_of(row->order)),
                 points_per_second(*row), rounded<4, &R::ns_per_point>(*row), us_per_call(*row),
                 rounded<4, &R::embree_ratio>(*row), std::to_string(row->answered), row->status});
    text += fmt::format("\n{}, {}: {} calls of {} points within {:.4g}\n{}", first.mesh, kind, first.calls,
                        first.points, first.reach, table.text());
  }
  return text;
}

void check_many(const validation::CsvTable& table, validation::Faults& faults) {
  validation::check_rows(table, many_columns(), many_columns().size(), faults,
                         [](const validation::RowCheck& row) {
                           row.check_fields(many_columns(), false);
                           check_numbers(row);
                         });
}

}  // namespace touchmark::bench::experiments::many
