#include "bench/experiments/papers/choi_sung/choi_sung_report.h"

#include <algorithm>
#include <functional>
#include <vector>

#include <fmt/format.h>

#include "bench/experiments/papers/paper_report.h"

namespace touchmark::bench::experiments::papers {
namespace {

std::string setting(const PaperMesh& mesh, const ChoiSungSettings& settings, const ChoiSungResult& result) {
  const bool own = is_choi_sungs_bunny(mesh.mesh);
  return fmt::format(
      "Subdivided as MeshLab does it: edges longer than {:.6g} split ({} % of level 0's diagonal, at every "
      "level; Catmull-Clark has no threshold and interpolates linearly). Clustering distance {:.6g}{}, "
      "triangles visited {}. {} steps of a slide over each surface itself, probe radius {:.6g}, seed {}. "
      "Detection time is one query of the published two levels: the probe against every sphere, then the "
      "triangles of the spheres it meets; the update rate is its inverse. tests_per_query counts spheres and "
      "triangles and is the same on every machine.\n\n{}{}",
      choi_sung_threshold_percent / 100 * mesh.mesh.diagonal(), choi_sung_threshold_percent,
      settings.clustering,
      own ? " (the paper's 0.02 in its own unit: this distance gives its 728 spheres at level 0)" : "",
      settings.order == VisitOrder::mesh ? "in the mesh's order" : "breadth-first over their edges",
      settings.steps, settings.radius, settings.seed,
      result.answers_agree ? "The exact forms (scan, tree, grid) answered every step alike, bit for bit.\n"
                           : "THE EXACT FORMS DISAGREED: see table1.csv.\n",
      result.finished ? "" : "INTERRUPTED: what follows is incomplete.\n");
}

/// Why every surface is slid over itself.
std::string contact_shares(const ChoiSungSettings& settings, const ChoiSungResult& result) {
  std::string shares;
  for (const SubdivisionMethod method : choi_sung_methods) {
    const ChoiSungRow* row = find_row(result, method, settings.levels, false);
    if (row == nullptr) continue;
    shares += fmt::format(
        "{}{} {:.0f} %", shares.empty() ? "" : ", ", name_of(method),
        100.0 * static_cast<double>(row->contacts_of_original_path) / static_cast<double>(settings.steps));
  }
  return fmt::format(
      "\nA path over level 0 would touch the surfaces of level {} in this share of its steps: {}. Loop flies "
      "free of it for the rest and would be paid for that with short times, so each surface is slid over by "
      "itself, and every step touches.\n",
      settings.levels, shares);
}

constexpr const char* what_is_missing =
    "The images of Tables 1 and 2 are not in the text at hand; of their numbers only those of LS3 (Table 3 "
    "and the Discussion) and the rankings in words can be compared. Table 2's appearance is the authors' own "
    "judgement, and its formula is not printed. Here each criterion is scored linearly from 0 for the worst "
    "method to 5 for the best; appearance is half creases (length-weighted root mean square of the angle "
    "between neighbouring faces), half mean distance of the original's vertices to the surface (they are "
    "where the object is known to be). Shrinking is rewarded in the other criteria: a smaller surface has "
    "smaller spheres, tighter by the printed formula (column tightness), and fewer edges above the fixed "
    "threshold, so fewer spheres and less time (columns detection_time and update_rate, which are one "
    "measurement scored twice).\n\n"
    "Not tested: that inner spheres miss boundary polygons, which follows from their being inside; that "
    "turned normals influence clustering, which as described goes by distance alone; that an approximating "
    "scheme makes it difficult to reach the final surface, of which the paper does not say by what.\n";

constexpr const char* future_work =
    "| the paper's sentence | here |\n| --- | --- |\n"
    "| the optimal number of iterations for speed and precision | `touchmark tune`, and \"Run time against "
    "error\" below |\n"
    "| contact levels of detail in real time | done, and not needed with an exact form: \"Contact levels of "
    "detail at run time\" below |\n"
    "| other real-case models | models.csv, on generated ones |\n"
    "| sharp features by improved subdivision schemes | not done: `touchmark tune` says where they would be "
    "rounded |\n";

/// The last row of LS3: what the fast forms do to the paper's trade-off.
std::string fast_forms_verdict(const ChoiSungResult& result) {
  const ChoiSungRow* single = find_row(result, SubdivisionMethod::ls3, 3, false);
  const ChoiSungRow* clustered = find_row(result, SubdivisionMethod::ls3, 3, true);
  if (single == nullptr || clustered == nullptr || !single->tree || !single->grid || single->tree->ns <= 0 ||
      single->grid->ns <= 0)
    return "";
  const double tree = single->scan->ns / single->tree->ns, grid = single->scan->ns / single->grid->ns;
  std::string text = fmt::format(
      "On LS3 level 3 ({} triangles) the exact tree answers {:.0f} times and the exact grid {:.0f} times as "
      "many queries a second as the published scan without clustering, and {:.0f} and {:.0f} times as many "
      "as with it.",
      single->surface.triangles, tree, grid, clustered->scan->ns / single->tree->ns,
      clustered->scan->ns / single->grid->ns);
  const ChoiSungRow* original = find_row(result, SubdivisionMethod::ls3, 0, false);
  if (original != nullptr && original->tree && original->grid && original->tree->ns > 0)
    text += fmt::format(
        " From level 0 to level 3 a query of the scan comes to take {:.3g} times as long, of the tree {:.3g} "
        "times and of the grid {:.3g} times.",
        single->scan->ns / original->scan->ns, single->tree->ns / original->tree->ns,
        single->grid->ns / original->grid->ns);
  return text + "\n";
}

/// The configurations that nothing beats, first among the published forms, then among all.
std::string frontier_section(const PaperMesh& mesh, const FrontierResult& frontier) {
  const auto published = [](const FrontierPoint& point) {
    return point.form == "scan" || point.form == "fast level";
  };
  const auto best = [&](const std::function<bool(const FrontierPoint&)>& among) {
    FrontierResult chosen = frontier;
    mark_best(chosen.points, among);
    std::erase_if(chosen.points, [](const FrontierPoint& point) { return !point.best; });
    std::ranges::sort(chosen.points,
                      [](const FrontierPoint& a, const FrontierPoint& b) { return a.ns < b.ns; });
    return frontier_table(chosen, mesh.mesh.diagonal()).markdown();
  };
  std::string text = fmt::format(
      "Error: |distance answered - distance to the smooth surface| at probes a tenth of the box diagonal off "
      "it. The smooth surface is LS3 after {} levels without a threshold ({} triangles), for every method: "
      "its own limit would excuse what a method does to the shape. The fast level answers with spheres, so "
      "its error holds their radii. {} configurations are in frontier.csv; those that none beats in both "
      "time and mean error:\n\n",
      frontier.reference_levels, frontier.reference_triangles, frontier.points.size());
  text += "As published:\n\n" + best(published);
  text += "\nWith the fast exact forms:\n\n" + best([](const FrontierPoint&) { return true; });
  return text;
}

std::string contact_levels_section(const PaperMesh& mesh, const ContactLevelResult& levels) {
  return fmt::format(
             "A session that, query by query, answers from the clustered spheres of the original, its "
             "triangles or those of LS3's levels, as published, and switches by what its recent queries took "
             "over the wanted period: to a faster level at once, to a slower one where that is expected to "
             "take at most {:.0f} % of the period for {} queries in a row. {} steps of approaching, pressing "
             "and retreating; the error is by how much the depth of contact differs from that of the smooth "
             "surface. rate_hz is what 99 of 100 queries hold.\n\n",
             100 * LevelSwitch::room, LevelSwitch::calm, levels.steps) +
         contact_levels_verdict(levels, mesh.mesh.diagonal()) + "\n" +
         contact_levels_table(levels, mesh.mesh.diagonal()).markdown();
}

}  // namespace

std::string choi_sung_report(const PaperMesh& mesh, const ChoiSungSettings& settings,
                             const ChoiSungResult& result, const FrontierResult& frontier,
                             const ContactLevelResult& levels) {
  const std::vector<Claim> claims = choi_sung_claims(result, is_choi_sungs_bunny(mesh.mesh));
  std::string text = "# Choi & Sung 2017, reproduced\n\n";
  text +=
      "A. R. Choi and M. Y. Sung, \"Performance improvement of haptic collision detection using subdivision "
      "surface and sphere clustering\", PLoS ONE 12(9), 2017.\n\n";
  text += report_setting(mesh) + "\n" + setting(mesh, settings, result) + "\n" + summary(claims) + "\n" +
          contact_shares(settings, result);
  const auto section = [&text](const char* title, const std::string& body) {
    text += fmt::format("\n## {}\n\n{}", title, body);
  };
  section("Number by number", claims_markdown(claims));
  section("The tool's triangles",
          "What the paper's tool, MeshLab, makes of the paper's mesh at its threshold. Only LS3's are "
          "printed (as spheres).\n\n" +
              claims_markdown(choi_sung_tool_counts(result, is_choi_sungs_bunny(mesh.mesh))));
  section("What cannot be compared", what_is_missing);
  section("Future work", future_work);
  section("Table 1",
          "Best of each level in bold, as the paper highlights it; more columns in table1.csv.\n\n" +
              choi_sung_table1_short(result).markdown());
  section("Table 2", choi_sung_table2(result).markdown());
  section("Table 3 (LS3)", choi_sung_table3(result).markdown());
  section("With the fast exact forms",
          fast_forms_verdict(result) + "\n" + choi_sung_fast_table(result).markdown());
  if (!frontier.points.empty()) section("Run time against error", frontier_section(mesh, frontier));
  if (levels.finished) section("Contact levels of detail at run time", contact_levels_section(mesh, levels));
  return text;
}

}  // namespace touchmark::bench::experiments::papers
