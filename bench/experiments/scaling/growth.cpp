#include "bench/experiments/scaling/growth.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "bench/experiments/scaling/mesh_sizes.h"
#include "bench/results/column.h"
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

constexpr std::array quantities{
    Quantity{"build_ms", "build", [](Row row) { return row.build_ms; }},
    Quantity{"first_answer_ms", "first answer", [](Row row) { return row.first_answer_ms; }},
    Quantity{"bytes", "bytes",
             [](Row row) { return row.bytes ? Value(static_cast<double>(*row.bytes)) : Value(); }},
    Quantity{"ns_per_query", "ns/query",
             [](Row row) { return row.throughput ? Value(row.throughput->undisturbed.ns) : Value(); }},
    Quantity{"ns_p50", "p50", [](Row row) { return row.latency ? Value(row.latency->p50) : Value(); }},
    Quantity{"ns_p999", "p99.9", [](Row row) { return measurement::p999_of(row, row.latency); }},
};

/// Returns true if rows of these two lie on one curve.
bool same_curve(Row a, Row b) {
  return a.contestant() == b.contestant() && a.trajectory == b.trajectory && a.query == b.query &&
         family_of(a.mesh) == family_of(b.mesh);
}

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

std::string rounded(double value) { return fmt::format("{:.6g}", value); }

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<Growth>>({
    {"schema", [](const Growth&) { return std::to_string(scaling_schema); }},
    {"detector", [](const Growth& growth) { return growth.detector; }},
    {"options", [](const Growth& growth) { return growth.options; }},
    {"trajectory", [](const Growth& growth) { return growth.trajectory; }},
    {"quantity", [](const Growth& growth) { return std::string(growth.quantity); }},
    {"points", [](const Growth& growth) { return std::to_string(growth.law.points); }},
    {"exponent", [](const Growth& growth) { return rounded(growth.law.exponent); }},
    {"exponent_low",
     [](const Growth& growth) { return growth.law.interval ? rounded(growth.law.interval->low) : ""; }},
    {"exponent_high",
     [](const Growth& growth) { return growth.law.interval ? rounded(growth.law.interval->high) : ""; }},
    {"factor", [](const Growth& growth) { return rounded(growth.law.factor); }},
    {"family", [](const Growth& growth) { return growth.family; }},
    {"query", [](const Growth& growth) { return std::string(workload::name_of(growth.query)); }},
    {"least_triangles", [](const Growth& growth) { return std::to_string(growth.min_triangles); }},
    {"most_triangles", [](const Growth& growth) { return std::to_string(growth.max_triangles); }},
});

std::string exponent_cell(const PowerLaw& law) {
  if (!law.interval) return fmt::format("{:.2f}", law.exponent);
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", law.exponent, law.interval->low, law.interval->high);
}

bool same_table(const Growth& a, const Growth& b) {
  return a.family == b.family && a.trajectory == b.trajectory && a.query == b.query;
}

}  // namespace

std::vector<Growth> growth_of(const std::vector<measurement::ResultRow>& rows) {
  std::vector<std::vector<const measurement::ResultRow*>> curves;
  for (const measurement::ResultRow& row : rows) {
    if (row.status != "ok") continue;
    const auto curve = std::find_if(curves.begin(), curves.end(),
                                    [&](const auto& known) { return same_curve(*known.front(), row); });
    (curve != curves.end() ? *curve : curves.emplace_back()).push_back(&row);
  }
  std::vector<Growth> growths;
  for (const auto& curve : curves) {
    for (const Quantity& quantity : quantities) {
      if (std::optional<Growth> growth = growth_along(curve, quantity)) growths.push_back(*std::move(growth));
    }
  }
  return growths;
}

std::string scaling_csv(const std::vector<Growth>& growths) {
  return results::table_of(columns, growths).csv();
}

std::string growth_table(const std::vector<Growth>& growths) {
  std::vector<std::string> header{"detector"};
  for (const Quantity& quantity : quantities) header.push_back(quantity.heading);
  std::string text;
  std::vector<const Growth*> tables;
  for (const Growth& growth : growths) {
    const auto same = [&](const Growth* known) { return same_table(*known, growth); };
    if (std::none_of(tables.begin(), tables.end(), same)) tables.push_back(&growth);
  }
  for (const Growth* kind : tables) {
    support::Table table(header);
    std::vector<std::string> names;
    for (const Growth& growth : growths) {
      const bool known = std::find(names.begin(), names.end(), growth.contestant()) != names.end();
      if (same_table(*kind, growth) && !known) names.push_back(growth.contestant());
    }
    for (const std::string& name : names) {
      std::vector<std::string> cells{name};
      for (const Quantity& quantity : quantities) {
        const auto found = std::find_if(growths.begin(), growths.end(), [&](const Growth& growth) {
          return same_table(*kind, growth) && growth.contestant() == name && growth.quantity == quantity.name;
        });
        cells.push_back(found == growths.end() ? "" : exponent_cell(found->law));
      }
      table.add(std::move(cells));
    }
    text += fmt::format("\n{}{}{}, {}: exponent of the number of triangles [95 % interval]\n{}", kind->family,
                        kind->family.empty() ? "" : ", ", kind->trajectory, workload::name_of(kind->query),
                        table.text());
  }
  return text;
}

}  // namespace touchmark::bench::experiments::scaling
