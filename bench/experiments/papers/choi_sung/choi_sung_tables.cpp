#include <array>
#include <functional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/papers/choi_sung/choi_sung_report.h"
#include "bench/experiments/papers/choi_sung/choi_sung_scores.h"
#include "bench/results/column.h"

namespace touchmark::bench::experiments::papers {
namespace {

std::string number(double value) { return fmt::format("{:.6g}", value); }
std::string milliseconds(double ns) { return ns > 0 ? number(ns * 1e-6) : ""; }
std::string hertz(double ns) { return ns > 0 ? number(1e9 / ns) : ""; }
std::string ratio(double ns, double other_ns) {
  return ns > 0 && other_ns > 0 ? fmt::format("{:.4g}", ns / other_ns) : "";
}

double ns_of(const std::optional<TimedTurns>& timed) { return timed ? timed->ns : 0; }
std::string work_of(const std::optional<TimedTurns>& timed) {
  return timed ? fmt::format("{:.1f}", timed->work) : "";
}

/// In percent of the first, how much less the second is.
std::string reduction(double without, double with) {
  return without > 0 && with > 0 ? fmt::format("{:.1f}", 100 * (1 - with / without)) : "";
}

/// A column of the short table: its text, and whether less is better.
struct ShortColumn {
  std::string name;
  std::function<double(const ChoiSungRow& single, const ChoiSungRow& clustered)> value;
  bool less_is_better;
};

std::vector<ShortColumn> short_columns() {
  using Row = ChoiSungRow;
  const auto us = [](const Row& row) { return ns_of(row.scan) * 1e-3; };
  const auto rate = [](const Row& row) { return row.scan && row.scan->ns > 0 ? 1e9 / row.scan->ns : 0; };
  return {
      {"triangles", [](const Row& a, const Row&) { return static_cast<double>(a.surface.triangles); }, true},
      {"mean area", [](const Row& a, const Row&) { return a.surface.mean_area; }, true},
      {"spheres", [](const Row& a, const Row&) { return static_cast<double>(a.spheres); }, true},
      {"clustered", [](const Row&, const Row& b) { return static_cast<double>(b.spheres); }, true},
      {"us", [us](const Row& a, const Row&) { return us(a); }, true},
      {"us, clustered", [us](const Row&, const Row& b) { return us(b); }, true},
      {"Hz", [rate](const Row& a, const Row&) { return rate(a); }, false},
      {"Hz, clustered", [rate](const Row&, const Row& b) { return rate(b); }, false}};
}

}  // namespace

support::Table choi_sung_table1(const ChoiSungResult& result) {
  using Row = const ChoiSungRow&;
  constexpr auto columns = std::to_array<results::Column<ChoiSungRow>>({
      {"method", [](Row row) { return row.surface.method; }},
      {"level", [](Row row) { return std::to_string(row.surface.level); }},
      {"clustering", [](Row row) { return number(row.clustering); }},
      {"triangles", [](Row row) { return std::to_string(row.surface.triangles); }},
      {"mean_triangle_area", [](Row row) { return number(row.surface.mean_area); }},
      {"spheres", [](Row row) { return std::to_string(row.spheres); }},
      {"tightness", [](Row row) { return number(row.tightness); }},
      {"relative_tightness", [](Row row) { return number(row.relative_tightness); }},
      {"relative_volume", [](Row row) { return number(row.surface.relative_volume); }},
      {"crease_deg", [](Row row) { return number(row.surface.crease_deg); }},
      {"contacts", [](Row row) { return row.scan ? std::to_string(row.scan->contacts) : ""; }},
      {"detection_ms", [](Row row) { return milliseconds(ns_of(row.scan)); }},
      {"update_rate_hz", [](Row row) { return hertz(ns_of(row.scan)); }},
      {"tests_per_query", [](Row row) { return work_of(row.scan); }},
      {"tree_ms", [](Row row) { return milliseconds(ns_of(row.tree)); }},
      {"tree_update_rate_hz", [](Row row) { return hertz(ns_of(row.tree)); }},
      {"tree_tests_per_query", [](Row row) { return work_of(row.tree); }},
      {"grid_ms", [](Row row) { return milliseconds(ns_of(row.grid)); }},
      {"grid_update_rate_hz", [](Row row) { return hertz(ns_of(row.grid)); }},
      {"grid_tests_per_query", [](Row row) { return work_of(row.grid); }},
      {"fast_level_ms", [](Row row) { return milliseconds(ns_of(row.fast)); }},
      // Level 2 is what both levels take beyond the first.
      {"precise_level_ms", [](Row row) { return milliseconds(ns_of(row.scan) - ns_of(row.fast)); }},
      {"triangles_per_query",
       [](Row row) {
         return row.scan ? fmt::format("{:.1f}", row.scan->work - static_cast<double>(row.spheres)) : "";
       }},
      {"vertices", [](Row row) { return std::to_string(row.surface.vertices); }},
      {"mean_edge_ratio", [](Row row) { return number(row.surface.mean_edge_ratio); }},
      {"mean_offset", [](Row row) { return number(row.surface.mean_offset); }},
      {"vertex_offset", [](Row row) { return number(row.surface.vertex_offset); }},
      {"centroid_radius", [](Row row) { return number(row.surface.centroid_radius); }},
      {"circumradius", [](Row row) { return number(row.surface.circumradius); }},
      {"scale_free_tightness", [](Row row) { return number(row.relative_looseness); }},
      {"contacts_of_original_path", [](Row row) { return std::to_string(row.contacts_of_original_path); }},
      {"concave_bending", [](Row row) { return number(row.surface.concave_bending); }},
      {"bottom_up_tightness",
       [](Row row) { return row.partitions ? number(row.partitions->bottom_up) : ""; }},
      {"top_down_tightness", [](Row row) { return row.partitions ? number(row.partitions->top_down) : ""; }},
  });
  return results::table_of(columns, result.rows);
}

support::Table choi_sung_table1_short(const ChoiSungResult& result) {
  const std::vector<ShortColumn> columns = short_columns();
  std::vector<std::string> header{"method", "level"};
  for (const ShortColumn& column : columns) header.push_back(column.name);
  support::Table table(std::move(header));
  const auto is_best = [&](const ShortColumn& column, std::size_t row) {
    const double sign = column.less_is_better ? 1 : -1;
    for (std::size_t i = 0; i + 1 < result.rows.size(); i += 2) {
      if (result.rows[i].surface.level != result.rows[row].surface.level) continue;
      if (sign * column.value(result.rows[i], result.rows[i + 1]) <
          sign * column.value(result.rows[row], result.rows[row + 1]))
        return false;
    }
    return true;
  };
  for (std::size_t i = 0; i + 1 < result.rows.size(); i += 2) {
    const SurfaceMeasures& surface = result.rows[i].surface;
    std::vector<std::string> cells{surface.method, std::to_string(surface.level)};
    for (const ShortColumn& column : columns) {
      const double value = column.value(result.rows[i], result.rows[i + 1]);
      const std::string text = value >= 1000 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
      cells.push_back(value <= 0 ? "" : surface.level > 0 && is_best(column, i) ? "**" + text + "**" : text);
    }
    table.add(std::move(cells));
  }
  return table;
}

support::Table choi_sung_distances(const ChoiSungResult& result) {
  support::Table table(
      {"mesh", "method", "level", "clustering", "spheres", "tests_per_query", "detection_ms", "mean_error"});
  for (const DistanceRow& row : result.distances)
    table.add({row.mesh, row.method, std::to_string(row.level), number(row.clustering),
               std::to_string(row.spheres), fmt::format("{:.1f}", row.tests_per_query),
               row.ns ? milliseconds(*row.ns) : "", row.mean_error ? number(*row.mean_error) : ""});
  return table;
}

support::Table choi_sung_models(const ChoiSungResult& result) {
  support::Table table({"model", "triangles", "where", "what", "holds", "reproduced"});
  for (const ModelVerdict& m : result.models)
    table.add({m.model, std::to_string(m.triangles), m.where, m.what, m.holds ? "yes" : "no", m.reproduced});
  return table;
}

support::Table choi_sung_table2(const ChoiSungResult& result) {
  support::Table table({"method", "appearance", "volume_equality", "tightness", "detection_time",
                        "update_rate", "total", "creases", "closeness"});
  const auto score = [](double value) { return fmt::format("{:.2f}", value); };
  for (const MethodScores& s : choi_sung_scores(result))
    table.add({std::string(name_of(s.method)), score(s.appearance), score(s.volume), score(s.tightness),
               score(s.detection), score(s.update), score(s.total()), score(s.creases), score(s.closeness)});
  return table;
}

support::Table choi_sung_table3(const ChoiSungResult& result) {
  support::Table table({"level", "spheres", "clustered_spheres", "sphere_reduction_percent", "detection_ms",
                        "clustered_detection_ms", "detection_reduction_percent", "update_rate_hz",
                        "clustered_update_rate_hz", "update_increment_percent"});
  for (int level = 0;; ++level) {
    const ChoiSungRow* single = find_row(result, SubdivisionMethod::ls3, level, false);
    const ChoiSungRow* clustered = find_row(result, SubdivisionMethod::ls3, level, true);
    if (single == nullptr || clustered == nullptr) return table;
    const double ns = ns_of(single->scan), clustered_ns = ns_of(clustered->scan);
    table.add({std::to_string(level), std::to_string(single->spheres), std::to_string(clustered->spheres),
               reduction(static_cast<double>(single->spheres), static_cast<double>(clustered->spheres)),
               milliseconds(ns), milliseconds(clustered_ns), reduction(ns, clustered_ns), hertz(ns),
               hertz(clustered_ns),
               clustered_ns > 0 && ns > 0 ? fmt::format("{:.1f}", 100 * (ns / clustered_ns - 1)) : ""});
  }
}

support::Table choi_sung_fast_table(const ChoiSungResult& result) {
  support::Table table({"method", "level", "triangles", "scan_update_rate_hz",
                        "clustered_scan_update_rate_hz", "tree_update_rate_hz", "grid_update_rate_hz",
                        "tree_over_scan", "grid_over_scan", "tree_over_clustered_scan",
                        "grid_over_clustered_scan"});
  for (std::size_t i = 0; i + 1 < result.rows.size(); i += 2) {
    const ChoiSungRow& single = result.rows[i];
    const double scan = ns_of(single.scan), clustered = ns_of(result.rows[i + 1].scan);
    const double tree = ns_of(single.tree), grid = ns_of(single.grid);
    table.add({single.surface.method, std::to_string(single.surface.level),
               std::to_string(single.surface.triangles), hertz(scan), hertz(clustered), hertz(tree),
               hertz(grid), ratio(scan, tree), ratio(scan, grid), ratio(clustered, tree),
               ratio(clustered, grid)});
  }
  return table;
}

}  // namespace touchmark::bench::experiments::papers
