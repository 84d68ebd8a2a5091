#include <algorithm>

#include <fmt/format.h>

#include "bench/experiments/papers/paper_report.h"
#include "bench/experiments/papers/park_jang/park_jang.h"

namespace touchmark::bench::experiments::papers {
namespace {

std::string number(double value) { return fmt::format("{:.6g}", value); }

/// What the numbers say of the paper's idea, for who reads no further.
std::string in_short(const ParkJangResult& result) {
  std::string text;
  for (const ParkJangCurve& curve : park_jang_curves(result)) {
    if (curve.shape != "cube") continue;
    const auto groups = [](const std::optional<double>& v) {
      return v ? fmt::format("{:.0f}", *v) : "none tried";
    };
    text += fmt::format(
        "- {} ({} triangles): a query takes a tenth of the ungrouped one's operations from {} cuboids on, "
        "fewest with {} ({:.3g} times fewer), a tenth more than that beyond {}. The best count of a single "
        "place is {} to {} in the middle half of the places.\n",
        curve.mesh, curve.triangles, groups(curve.tenth_from), curve.best, curve.factor,
        groups(curve.rises_from), curve.best_of_places_from, curve.best_of_places_to);
  }
  return text.empty() ? "" : "\n## In short\n\n" + text;
}

constexpr const char* not_comparable =
    "Neither the mesh's size, nor the path, nor the machine is stated, and the HIP there is a point, here a "
    "ball. The scan of the text leaves much of it illegible: a number is called certain where it stands in "
    "two places, likely where it stands in one; no sentence on future work could be read.\n";

std::string fast_verdict(const ParkJangResult& result) {
  std::string text;
  const std::vector<ParkJangBest> all = park_jang_best(result);
  for (const ParkJangRow& row : result.rows) {
    if (row.form != "direct" || !row.timed || row.timed->ns <= 0) continue;
    for (const ParkJangBest& best : all)
      if (best.mesh == row.mesh && best.shape == "cube")
        text += fmt::format(
            "- {}: {:.0f} times as fast as the published form at its best count, {:.0f} times as fast as the "
            "ungrouped one.\n",
            row.mesh, best.ns / row.timed->ns, best.ungrouped_ns / row.timed->ns);
  }
  return text;
}

}  // namespace

support::Table park_jang_times(const ParkJangResult& result) {
  support::Table table({"mesh", "triangles", "form", "cell", "groups", "detection_ms", "update_rate_hz",
                        "tests_per_query", "contacts", "times_ungrouped", "operations_per_query",
                        "operations_low", "operations_high", "operations_over_ungrouped",
                        "groups_per_triangle"});
  double ungrouped = 0, ungrouped_operations = 0;
  for (const ParkJangRow& row : result.rows) {
    const double ns = row.timed ? row.timed->ns : 0;
    if (row.form == "ungrouped") {
      ungrouped = ns;
      ungrouped_operations = operations_of(row, row.counted.mean);
    }
    const auto operations = [&row](double tests) {
      return row.form == "direct" ? "" : fmt::format("{:.0f}", operations_of(row, tests));
    };
    table.add({row.mesh, std::to_string(row.triangles), row.form, row.cell > 0 ? number(row.cell) : "",
               row.groups > 0 ? std::to_string(row.groups) : "", ns > 0 ? number(ns * 1e-6) : "",
               ns > 0 ? number(1e9 / ns) : "", fmt::format("{:.1f}", row.counted.mean),
               std::to_string(row.counted.contacts),
               ns > 0 && ungrouped > 0 ? fmt::format("{:.4g}", ungrouped / ns) : "",
               operations(row.counted.mean), operations(place_quantile(row.counted, 0.1)),
               operations(place_quantile(row.counted, 0.9)),
               ungrouped_operations > 0 && row.form != "direct"
                   ? fmt::format("{:.4g}", operations_of(row, row.counted.mean) / ungrouped_operations)
                   : "",
               row.groups_per_triangle > 0 ? fmt::format("{:.2f}", row.groups_per_triangle) : ""});
  }
  return table;
}

support::Table park_jang_best_table(const ParkJangResult& result) {
  support::Table table({"mesh", "triangles", "shape", "best_groups", "within_10_percent_from",
                        "within_10_percent_to", "detection_ms", "ungrouped_ms", "factor", "most_groups_ms",
                        "best_groups_by_operations", "best_of_places_from", "best_of_places_to",
                        "factor_by_operations", "tenth_from", "rises_from"});
  const std::vector<ParkJangCurve> curves = park_jang_curves(result);
  for (const ParkJangBest& best : park_jang_best(result)) {
    const auto found = std::ranges::find_if(
        curves, [&](const ParkJangCurve& c) { return c.mesh == best.mesh && c.shape == best.shape; });
    const ParkJangCurve curve = found != curves.end() ? *found : ParkJangCurve();
    const auto whole = [](const std::optional<double>& v) { return v ? fmt::format("{:.0f}", *v) : ""; };
    table.add({best.mesh, std::to_string(best.triangles), best.shape, std::to_string(best.groups),
               std::to_string(best.from), std::to_string(best.to), number(best.ns * 1e-6),
               number(best.ungrouped_ns * 1e-6), fmt::format("{:.2f}", best.factor()),
               number(best.last_ns * 1e-6), std::to_string(curve.best),
               std::to_string(curve.best_of_places_from), std::to_string(curve.best_of_places_to),
               fmt::format("{:.2f}", curve.factor), whole(curve.tenth_from), whole(curve.rises_from)});
  }
  return table;
}

std::string park_jang_report(const std::vector<PaperMesh>& meshes, const ParkJangSettings& settings,
                             const ParkJangResult& result) {
  const std::vector<Claim> claims = park_jang_claims(result);
  std::string text = "# Park & Jang 2018, reproduced\n\n";
  text +=
      "J.-S. Park and T.-J. Jang, on mesh grouping for fast collision detection in haptics, Journal of "
      "Digital Contents Society 19(1), 2018, pp. 199-204 (in Korean).\n\n";
  text += report_machine() + "\nMeshes:\n";
  for (const PaperMesh& mesh : meshes)
    text += fmt::format("- {}: {} triangles ({})\n", mesh.name, mesh.mesh.size(), mesh.origin);
  text += fmt::format(
      "\n{} steps in {} places of each mesh (slides, each of a seed of its own), of which {} are timed; "
      "probe radius {:.6g}{}, first seed {}. A query tests the probe against every group (a cuboid, the "
      "smallest sphere, or the sphere about the cuboid's centre, around the triangles of one cell), then the "
      "triangles of the groups that hold it; ungrouped, every triangle. Compared are the operations of a "
      "query, the same on every machine: {:.0f} for a cuboid, {:.0f} for a sphere, {:.0f} for a triangle, as "
      "the textbook that the paper cites tests them (a triangle on average; 29 to 86 by where the point is); "
      "times are second.\n{}{}\n",
      settings.steps, settings.places, std::min(settings.timed_steps, settings.steps), settings.radius.value,
      settings.radius.percent ? " % of the box diagonal" : "", settings.seed, cuboid_operations,
      sphere_operations, triangle_operations,
      result.answers_agree ? "All forms answered every step alike, bit for bit.\n"
                           : "THE FORMS DISAGREED on some mesh.\n",
      result.finished ? summary(claims) : "INTERRUPTED: what follows is incomplete.");
  text += in_short(result);
  text += "\n## Number by number\n\n" + claims_markdown(claims);
  text += "\n## What cannot be compared\n\n";
  text += not_comparable;
  text += "\n## Best count and factor gained\n\n" + park_jang_best_table(result).markdown();
  text +=
      "\n## With the fast exact form\n\nThe grid that looks only into the probe's own cell (grid-group, "
      "lookup=direct):\n\n" +
      fast_verdict(result);
  text += "\nEvery count and time is in times.csv.\n";
  return text;
}

}  // namespace touchmark::bench::experiments::papers
