#include "bench/experiments/scaling/growth.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/experiments/scaling/mesh_sizes.h"
#include "bench/results/column.h"
#include "bench/support/grouping.h"
#include "bench/support/names.h"
#include "bench/support/table.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::scaling {
namespace {

constexpr int scaling_schema = 1;

struct Quantity {
  std::string_view name;
  const char* heading;
  std::optional<double> (*of)(const measurement::ResultRow& row);
};

using Row = const measurement::ResultRow&;
using Value = std::optional<double>;

template <std::uint64_t Work::*Counter>
Value mean_of(Row row) {
  if (!row.work) return std::nullopt;
  return static_cast<double>(row.work->total.*Counter) / static_cast<double>(row.steps);
}

Value time_of(Row row) { return row.throughput ? Value(row.throughput->undisturbed.ns) : Value(); }
Value looks_of(Row row) { return row.work ? Value(row.work->mean) : Value(); }
Value time_of_look(Row row) {
  const Value time = time_of(row), looks = looks_of(row);
  return time && looks && *looks > 0 ? Value(*time / *looks) : Value();
}

constexpr std::array quantities{
    Quantity{"build_ms", "build", [](Row row) { return row.build_ms; }},
    Quantity{"first_answer_ms", "first answer", [](Row row) { return row.first_answer_ms; }},
    Quantity{"bytes", "bytes",
             [](Row row) { return row.bytes ? Value(static_cast<double>(*row.bytes)) : Value(); }},
    Quantity{"ns_per_query", "ns/query", time_of},
    Quantity{"ns_p50", "p50", [](Row row) { return row.latency ? Value(row.latency->p50) : Value(); }},
    Quantity{"ns_p999", "p99.9", [](Row row) { return measurement::p999_of(row, row.latency); }},
};

/// What the exponent of ns_per_query is made of: looks and the time of a look, and the looks by kind.
constexpr std::array causes{
    Quantity{"work_mean", "looks", looks_of},
    Quantity{"ns_per_look", "ns/look", time_of_look},
    Quantity{"cells_mean", "cells", mean_of<&Work::cells>},
    Quantity{"spheres_mean", "spheres", mean_of<&Work::spheres>},
    Quantity{"boxes_mean", "boxes", mean_of<&Work::boxes>},
    Quantity{"triangles_mean", "triangles", mean_of<&Work::triangles>},
};

std::optional<Growth> growth_along(const std::vector<const measurement::ResultRow*>& curve,
                                   const Quantity& quantity) {
  Growth growth;
  std::vector<SizedQuantity> points;
  for (const measurement::ResultRow* row : curve) {
    const Value value = quantity.of(*row);
    if (!value || !(*value > 0)) continue;
    points.push_back({static_cast<double>(row->triangles), *value});
    growth.max_triangles = std::max(growth.max_triangles, row->triangles);
    growth.min_triangles =
        points.size() == 1 ? row->triangles : std::min(growth.min_triangles, row->triangles);
  }
  const std::optional<PowerLaw> law = fit_power_law(points);
  if (!law) return std::nullopt;
  Row first = *curve.front();
  growth.detector = first.detector;
  growth.options = first.options;
  growth.family = family_of(first.mesh);
  growth.trajectory = first.trajectory;
  growth.query = first.query;
  growth.quantity = quantity.name;
  growth.law = *law;
  return growth;
}

using G = Growth;
using results::text, results::rounded;

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<G>>({
    {"schema", [](const G&) { return std::to_string(scaling_schema); }},
    {"detector", text<&G::detector>},
    {"options", text<&G::options>},
    {"trajectory", text<&G::trajectory>},
    {"quantity", text<&G::quantity>},
    {"points", text<&G::law, &PowerLaw::points>},
    {"exponent", rounded<6, &G::law, &PowerLaw::exponent>},
    {"exponent_low", rounded<6, &G::law, &PowerLaw::interval, &ExponentInterval::low>},
    {"exponent_high", rounded<6, &G::law, &PowerLaw::interval, &ExponentInterval::high>},
    {"factor", rounded<6, &G::law, &PowerLaw::factor>},
    {"family", text<&G::family>},
    {"query", text<&G::query>},
    {"least_triangles", text<&G::min_triangles>},
    {"most_triangles", text<&G::max_triangles>},
    {"shrinks", text<&G::shrinks>},
});

std::string exponent_cell(const PowerLaw& law) {
  if (!law.interval) return fmt::format("{:.2f}", law.exponent);
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", law.exponent, law.interval->low, law.interval->high);
}

/// A row a contestant, a column a quantity.
std::string exponents_of(const std::vector<const Growth*>& growths, std::span<const Quantity> columns_of) {
  std::vector<std::string> header{"detector"};
  for (const Quantity& quantity : columns_of) header.push_back(quantity.heading);
  support::Table table(header);
  for (const auto& [name, curves] :
       support::grouped_by(growths, [](const Growth& growth) { return growth.contestant(); })) {
    std::vector<std::string> cells{name};
    for (const Quantity& quantity : columns_of) {
      const auto found = std::ranges::find(curves, quantity.name, &Growth::quantity);
      cells.push_back(found == curves.end() ? "" : exponent_cell((*found)->law));
    }
    table.add(std::move(cells));
  }
  return table.text();
}

}  // namespace

constexpr std::array<support::Name<Shrinks>, 2> shrinks_by_name{
    {{Shrinks::reach, "reach"}, {Shrinks::reach_and_motion, "all"}}};

std::string_view name_of(Shrinks shrinks) noexcept { return support::name_in(shrinks_by_name, shrinks); }

std::vector<Growth> growth_of(const std::vector<measurement::ResultRow>& rows, Shrinks shrinks) {
  std::vector<const measurement::ResultRow*> fitted;
  for (const measurement::ResultRow& row : rows)
    if (row.status == "ok") fitted.push_back(&row);
  const auto curves = support::grouped_by(fitted, [](Row row) {
    return std::tuple(row.contestant(), row.trajectory, row.query, family_of(row.mesh));
  });
  std::vector<Growth> growths;
  const auto add = [&](const std::vector<const measurement::ResultRow*>& curve, const Quantity& quantity) {
    std::optional<Growth> growth = growth_along(curve, quantity);
    if (!growth) return;
    growth->shrinks = shrinks;
    growths.push_back(*std::move(growth));
  };
  for (const auto& [_, curve] : curves) {
    for (const Quantity& quantity : quantities) add(curve, quantity);
    for (const Quantity& cause : causes) add(curve, cause);
  }
  return growths;
}

std::string scaling_csv(const std::vector<Growth>& growths) {
  return results::table_of(columns, growths).csv();
}

std::string growth_table(const std::vector<Growth>& growths) {
  const auto kinds = support::grouped_by(growths, [](const Growth& growth) {
    return std::tuple(growth.family, growth.trajectory, workload::name_of(growth.query));
  });
  std::string text;
  for (const auto& [kind, of_kind] : kinds) {
    const auto& [family, trajectory, query] = kind;
    text += fmt::format("\n{}{}{}, {}: exponent of the number of triangles [95 % interval]\n{}", family,
                        family.empty() ? "" : ", ", trajectory, query, exponents_of(of_kind, quantities));
    text += fmt::format("\nof which: ns/query is looks times ns/look, and looks are of these kinds\n{}",
                        exponents_of(of_kind, causes));
  }
  return text;
}

}  // namespace touchmark::bench::experiments::scaling
