#include <array>
#include <string>

#include <fmt/format.h>

#include "bench/experiments/papers/choi_sung_report.h"
#include "bench/experiments/papers/choi_sung_scores.h"
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
  });
  return results::table_of(columns, result.rows);
}

support::Table choi_sung_table2(const ChoiSungResult& result) {
  support::Table table(
      {"method", "appearance", "volume_equality", "tightness", "detection_time", "update_rate", "total"});
  const auto score = [](double value) { return fmt::format("{:.2f}", value); };
  for (const MethodScores& s : choi_sung_scores(result)) {
    table.add({std::string(name_of(s.method)), score(s.appearance), score(s.volume), score(s.tightness),
               score(s.detection), score(s.update), score(s.total())});
  }
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
