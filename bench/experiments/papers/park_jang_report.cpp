#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "bench/experiments/papers/paper_report.h"
#include "bench/experiments/papers/park_jang.h"
#include "bench/support/median.h"

namespace touchmark::bench::experiments::papers {
namespace {

std::string number(double value) { return fmt::format("{:.6g}", value); }

/// A reason for what depends on the mesh, which the paper does not describe: what came out on those tried, of
/// one shape of groups, smallest mesh first.
std::string unknown_mesh(const std::string& what, std::vector<ParkJangBest> tried, double printed,
                         const std::function<double(const ParkJangBest&)>& value) {
  std::string text = "the paper does not state its mesh's size";
  if (tried.size() < 2) return text;
  std::stable_sort(tried.begin(), tried.end(),
                   [](const auto& a, const auto& b) { return a.triangles < b.triangles; });
  std::vector<double> values;
  for (const ParkJangBest& best : tried) values.push_back(value(best));
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  text += fmt::format("; on the meshes tried {} {} {:.4g} to {:.4g}", what,
                      std::is_sorted(values.begin(), values.end()) ? "grows with the triangles, from" : "is",
                      *least, *most);
  return text + (*least <= printed && printed <= *most ? ": a mesh between them would give the printed one"
                                                       : ": none of them gives the printed one");
}

std::vector<ParkJangBest> of_shape(const std::vector<ParkJangBest>& all, const std::string& shape) {
  std::vector<ParkJangBest> chosen;
  std::copy_if(all.begin(), all.end(), std::back_inserter(chosen),
               [&](const ParkJangBest& best) { return best.shape == shape; });
  return chosen;
}

/// Spheres against cubes of the same cells, up to the best count of cubes and beyond.
struct SpheresAgainstCubes {
  std::vector<double> up_to_best, beyond;  ///< spheres' time over cubes'
};

SpheresAgainstCubes compare_shapes(const ParkJangResult& result) {
  SpheresAgainstCubes found;
  const std::vector<ParkJangBest> all = park_jang_best(result);
  for (const ParkJangRow& sphere : result.rows) {
    if (sphere.form != "sphere" || !sphere.timed || sphere.timed->ns <= 0) continue;
    const auto best = std::find_if(all.begin(), all.end(), [&](const ParkJangBest& b) {
      return b.mesh == sphere.mesh && b.shape == "cube";
    });
    for (const ParkJangRow& cube : result.rows) {
      if (cube.form != "cube" || cube.mesh != sphere.mesh || cube.groups != sphere.groups ||
          cube.timed->ns <= 0)
        continue;
      (cube.groups <= best->groups ? found.up_to_best : found.beyond)
          .push_back(sphere.timed->ns / cube.timed->ns);
    }
  }
  return found;
}

bool mostly_slower(const std::vector<double>& ratios) {
  const auto slower = std::count_if(ratios.begin(), ratios.end(), [](double ratio) { return ratio > 1; });
  return 4 * static_cast<std::size_t>(slower) >= 3 * ratios.size();
}

Claim shapes_claim(const SpheresAgainstCubes& shapes) {
  Claim claim{"Fig. 7", "spheres are slower than cubes at equal count", "holds",
              fmt::format("{:.2f} times as long up to the best count, {:.2f} times beyond (medians)",
                          support::median(shapes.up_to_best), support::median(shapes.beyond))};
  const bool early = mostly_slower(shapes.up_to_best), late = mostly_slower(shapes.beyond);
  claim.agreement = early && late ? Agreement::yes : early ? Agreement::nearly : Agreement::no;
  if (!(early && late)) {
    claim.why =
        "a sphere holds more space than the cuboid of the same triangles, so more triangles are tested; but "
        "its own "
        "test is the cheaper one here (a squared distance, no root), which decides where groups are many";
  }
  return claim;
}

Claim best_count_claim(const ParkJangBest& best, const std::vector<ParkJangBest>& all) {
  Claim claim{"Fig. 7", fmt::format("groups from where on the time rises, {} {}s", best.mesh, best.shape),
              "about 783", fmt::format("{} (within 10 %: {} to {})", best.groups, best.from, best.to)};
  const bool inside = best.from <= park_jang_turn && park_jang_turn <= best.to;
  const double off =
      std::abs(std::log2(static_cast<double>(best.groups) / static_cast<double>(park_jang_turn)));
  claim.agreement = inside ? Agreement::yes : off <= 1 ? Agreement::nearly : Agreement::no;
  if (!inside) {
    claim.why = unknown_mesh(fmt::format("the best count of {}s", best.shape), of_shape(all, best.shape),
                             static_cast<double>(park_jang_turn),
                             [](const ParkJangBest& b) { return static_cast<double>(b.groups); });
  }
  return claim;
}

Claim factor_claim(const ParkJangBest& best, const std::vector<ParkJangBest>& all) {
  constexpr double printed = 10;
  Claim claim{"Fig. 7, abstract",
              fmt::format("best time, of the ungrouped one, {} {}s", best.mesh, best.shape), "about 1/10",
              fmt::format("1/{:.1f}", best.factor())};
  const double off = std::abs(std::log2(best.factor() / printed));
  claim.agreement = off <= 0.2 ? Agreement::yes : off <= 1 ? Agreement::nearly : Agreement::no;
  if (claim.agreement != Agreement::yes) {
    claim.why = unknown_mesh(fmt::format("the factor gained by {}s", best.shape), of_shape(all, best.shape),
                             printed, [](const ParkJangBest& b) { return b.factor(); }) +
                (best.factor() > printed
                     ? "; a fixed part in their times, which grouping does not shrink, would explain a "
                       "smaller gain than that of the search alone"
                     : "");
  }
  return claim;
}

}  // namespace

support::Table park_jang_times(const ParkJangResult& result) {
  support::Table table({"mesh", "triangles", "form", "cell", "groups", "detection_ms", "update_rate_hz",
                        "tests_per_query", "contacts", "times_ungrouped"});
  double ungrouped = 0;
  for (const ParkJangRow& row : result.rows) {
    const double ns = row.timed ? row.timed->ns : 0;
    if (row.form == "ungrouped") ungrouped = ns;
    table.add({row.mesh, std::to_string(row.triangles), row.form, row.cell > 0 ? number(row.cell) : "",
               row.groups > 0 ? std::to_string(row.groups) : "", ns > 0 ? number(ns * 1e-6) : "",
               ns > 0 ? number(1e9 / ns) : "", row.timed ? fmt::format("{:.1f}", row.timed->work) : "",
               row.timed ? std::to_string(row.timed->contacts) : "",
               ns > 0 && ungrouped > 0 ? fmt::format("{:.4g}", ungrouped / ns) : ""});
  }
  return table;
}

support::Table park_jang_best_table(const ParkJangResult& result) {
  support::Table table({"mesh", "triangles", "shape", "best_groups", "within_10_percent_from",
                        "within_10_percent_to", "detection_ms", "ungrouped_ms", "factor", "most_groups_ms"});
  for (const ParkJangBest& best : park_jang_best(result)) {
    table.add({best.mesh, std::to_string(best.triangles), best.shape, std::to_string(best.groups),
               std::to_string(best.from), std::to_string(best.to), number(best.ns * 1e-6),
               number(best.ungrouped_ns * 1e-6), fmt::format("{:.2f}", best.factor()),
               number(best.last_ns * 1e-6)});
  }
  return table;
}

std::vector<Claim> park_jang_claims(const ParkJangResult& result) {
  std::vector<Claim> claims;
  if (!result.finished) return claims;
  const std::vector<ParkJangBest> all = park_jang_best(result);
  for (const ParkJangRow& row : result.rows) {
    if (row.form != "ungrouped") continue;
    Claim claim{"Fig. 7", fmt::format("ungrouped time, {} triangles, ms", row.triangles),
                "about 1 (hard to read)", fmt::format("{:.3g}", row.timed->ns * 1e-6)};
    const double off = std::abs(std::log2(row.timed->ns * 1e-6));
    claim.agreement = off <= 0.3 ? Agreement::yes : off <= 1 ? Agreement::nearly : Agreement::no;
    if (claim.agreement != Agreement::yes) claim.why = "another machine, and their mesh's size is not stated";
    claims.push_back(claim);
  }
  for (const ParkJangBest& best : all) claims.push_back(best_count_claim(best, all));
  for (const ParkJangBest& best : all) claims.push_back(factor_claim(best, all));
  for (const ParkJangBest& best : all) {
    claims.push_back(statement_claim(
        "Fig. 7", fmt::format("beyond the best count the time rises again, {} {}s", best.mesh, best.shape),
        best.last_ns > 1.2 * best.ns,
        fmt::format("{:.2f} times the best at the most groups", best.last_ns / best.ns),
        "more groups than were tried would be needed"));
  }
  claims.push_back(shapes_claim(compare_shapes(result)));
  return claims;
}

namespace {

/// What the numbers say of the paper's idea, for who reads no further.
std::string in_short(const ParkJangResult& result) {
  std::string text;
  for (const ParkJangBest& best : park_jang_best(result)) {
    if (best.shape != "cube" || best.ns <= 0) continue;
    text += fmt::format(
        "- {} ({} triangles): {} cuboids are the best count and answer {:.3g} times as fast as no groups; "
        "with "
        "the most cuboids tried a query takes {:.3g} times as long as with the best count.\n",
        best.mesh, best.triangles, best.groups, best.factor(), best.last_ns / best.ns);
  }
  return text.empty() ? "" : "\n## In short\n\n" + text;
}

std::string fast_verdict(const ParkJangResult& result) {
  std::string text;
  const std::vector<ParkJangBest> all = park_jang_best(result);
  for (const ParkJangRow& row : result.rows) {
    if (row.form != "direct" || !row.timed || row.timed->ns <= 0) continue;
    for (const ParkJangBest& best : all) {
      if (best.mesh == row.mesh && best.shape == "cube")
        text += fmt::format(
            "- {}: {:.0f} times as fast as the published form at its best count, {:.0f} times as fast as the "
            "ungrouped one.\n",
            row.mesh, best.ns / row.timed->ns, best.ungrouped_ns / row.timed->ns);
    }
  }
  return text;
}

}  // namespace

std::string park_jang_report(const std::vector<PaperMesh>& meshes, const ParkJangSettings& settings,
                             const ParkJangResult& result) {
  const std::vector<Claim> claims = park_jang_claims(result);
  std::string text = "# Park & Jang 2018, reproduced\n\n";
  text +=
      "J.-S. Park and T.-J. Jang, on mesh grouping for fast collision detection in haptics, Journal of "
      "Digital "
      "Contents Society 19(1), 2018, pp. 199-204 (in Korean).\n\n";
  text += report_machine() + "\nMeshes:\n";
  for (const PaperMesh& mesh : meshes)
    text += fmt::format("- {}: {} triangles ({})\n", mesh.name, mesh.mesh.size(), mesh.origin);
  text += fmt::format(
      "\n{} steps of a slide over each mesh, probe radius {:.6g}{}, seed {}. A query tests the probe against "
      "every "
      "group (the smallest box or sphere around the triangles of one cell), then the triangles of the groups "
      "that hold "
      "it; ungrouped, every triangle.\n{}{}\n",
      settings.steps, settings.radius.value, settings.radius.percent ? " % of the box diagonal" : "",
      settings.seed,
      result.answers_agree ? "All forms answered every step alike, bit for bit.\n"
                           : "THE FORMS DISAGREED on some mesh.\n",
      result.finished ? summary(claims) : "INTERRUPTED: what follows is incomplete.");
  text += in_short(result);
  text += "\n## Number by number\n\n" + claims_markdown(claims);
  text += "\n## Best count and factor gained\n\n" + park_jang_best_table(result).markdown();
  text +=
      "\n## With the fast exact form\n\nThe grid that looks only into the probe's own cell (grid-group, "
      "lookup=direct):\n\n" +
      fast_verdict(result);
  text += "\n## Every time\n\n" + park_jang_times(result).markdown();
  return text;
}

}  // namespace touchmark::bench::experiments::papers
