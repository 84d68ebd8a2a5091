/// `touchmark tune`: the level of subdivision and the clustering distance that hold a wanted rate at the
/// least geometric error, the question that Choi & Sung 2017 leave to future work.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/extra/papers/paper_options.h"
#include "bench/cli/options.h"
#include "bench/cli/run_frame.h"
#include "bench/experiments/papers/frontier.h"
#include "bench/experiments/papers/tuning.h"
#include "bench/meshes/meshes.h"
#include "bench/support/checked.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/system/interrupt.h"
#include "bench/support/table.h"

namespace touchmark::bench::cli {

namespace papers = experiments::papers;

namespace {

struct TuneOptions {
  std::string mesh, rate, levels, reference, threshold = "1%";
  std::vector<std::string> methods, clusterings;
  PaperOptions common{"", "0.5%", "", "1", false};
};

std::vector<SubdivisionMethod> checked_methods(const std::vector<std::string>& names) {
  std::vector<SubdivisionMethod> methods;
  for (const std::string& name : names) {
    const std::optional<SubdivisionMethod> method = subdivision_method(name);
    if (!method) throw support::bad_value("--method", name, "a subdivision method (mesh subdivide)");
    methods.push_back(*method);
  }
  return methods.empty() ? std::vector{SubdivisionMethod::ls3} : methods;
}

std::vector<double> checked_clusterings(const std::vector<std::string>& texts, const TriangleMesh& mesh) {
  std::vector<double> distances;
  for (const std::string& text : texts)
    distances.push_back(support::checked_length("--clustering", text).in_mesh_units(mesh));
  if (!distances.empty()) return distances;
  for (const double times : {0.0, 0.5, 1.0, 2.0, 4.0})
    distances.push_back(times * papers::choi_sung_clustering_percent / 100 * mesh.diagonal());
  return distances;
}

papers::FrontierSettings checked(const TuneOptions& options, const TriangleMesh& mesh) {
  const bool quick = options.common.quick;
  papers::FrontierSettings settings;
  settings.methods = checked_methods(options.methods);
  settings.levels = static_cast<int>(support::count_or(quick ? 1 : 3, "--levels", options.levels, 0, 8));
  settings.threshold = support::checked_length("--threshold", options.threshold).in_mesh_units(mesh);
  settings.clusterings = checked_clusterings(options.clusterings, mesh);
  settings.radius = support::checked_length("--radius", options.common.radius).in_mesh_units(mesh);
  settings.steps = support::count_or(quick ? 50 : 1000, "--steps", options.common.steps, 1, 1'000'000);
  settings.seed = support::checked_seed(options.common.seed);
  if (!options.reference.empty())
    settings.reference = meshes::load_mesh(options.reference);
  else if (papers::sharp_edges(mesh).share >= papers::mostly_sharp)
    settings.reference = mesh;
  if (quick) {
    settings.samples = 100;
    settings.effort = {2, 1e5};
  }
  return settings;
}

double percent_of(double error, double diagonal) { return diagonal > 0 ? 100 * error / diagonal : 0; }

std::string table_of(const papers::FrontierResult& result, double diagonal, double rate) {
  support::Table table({"surface", "form", "clustering", "triangles", "spheres", "error %", "99 % within us",
                        "Hz", "in time", "best"});
  for (const papers::FrontierPoint& p : result.points)
    table.add({fmt::format("{} {}", p.method, p.level), p.form, fmt::format("{:.4g}", p.clustering),
               std::to_string(p.triangles), std::to_string(p.spheres),
               fmt::format("{:.4f}", percent_of(p.error.mean, diagonal)),
               p.ns_p99 ? fmt::format("{:.3g}", *p.ns_p99 * 1e-3) : "",
               p.ns_p99 ? fmt::format("{:.4g}", 1e9 / *p.ns_p99) : "",
               papers::holds_rate(p, rate) ? "yes" : "no", p.best ? "*" : ""});
  return table.text();
}

std::string description(const char* which, const std::optional<papers::FrontierPoint>& point,
                        const TuneOptions& options, double diagonal) {
  if (!point || !point->ns_p99) return fmt::format("{}: none holds {} Hz\n", which, options.rate);
  std::string text = fmt::format(
      "{}: {} level {}, {}, mean error {:.4f} % of the box diagonal, 99 of 100 queries within {:.4g} us\n",
      which, point->method, point->level, papers::detector_of(*point),
      percent_of(point->error.mean, diagonal), *point->ns_p99 * 1e-3);
  if (point->level > 0)
    text += fmt::format(
        "  touchmark mesh subdivide --mesh {} --method {} --levels {} --threshold {} --form meshlab --output "
        "fine.ply\n",
        options.mesh, point->method, point->level, options.threshold);
  text += fmt::format("  touchmark bench --mesh {} --detector {}\n",
                      point->level > 0 ? "fine.ply" : options.mesh, papers::detector_of(*point));
  return text;
}

/// What the error is measured against, and what that says of sharp edges.
std::string reference_note(const TuneOptions& options, const TriangleMesh& mesh,
                           const papers::FrontierResult& result) {
  if (!options.reference.empty())
    return fmt::format("error: against {} ({} triangles)\n", options.reference, result.reference_triangles);
  const papers::SharpEdges sharp = papers::sharp_edges(mesh);
  const std::string edges =
      fmt::format("{} edges ({:.0f} % of the bent ones' length) turn by more than 60 degrees", sharp.count,
                  100 * sharp.share);
  if (sharp.share >= papers::mostly_sharp)
    return fmt::format(
        "error: against the mesh as it is, since {}: subdivision would round them. --reference FINE names "
        "what is true.\n",
        edges);
  std::string text = fmt::format(
      "error: against LS3's own limit surface ({} triangles), not against the object: --reference FINE names "
      "a scan or a CAD tessellation of that.\n",
      result.reference_triangles);
  if (sharp.count > 0)
    text += fmt::format("warning: {}; if these are corners of the object, subdivision rounds them.\n", edges);
  return text;
}

int run(const ProgramContext& context, const TuneOptions& options) {
  const double rate = support::checked_positive("--rate", options.rate);
  const TriangleMesh mesh = meshes::load_mesh(options.mesh);
  const papers::FrontierSettings settings = checked(options, mesh);
  RunFrame frame(context, options.common.out);
  support::watch_for_interrupts();
  const papers::LevelSearch search =
      papers::search_levels(mesh, settings, rate, !options.levels.empty(),
                            [&](const std::string& what) { frame.progress.show(what); });
  const papers::FrontierResult& result = search.result;
  frame.progress.clear();
  if (frame.folder)
    frame.folder->write_file("tune.csv", papers::frontier_table(result, mesh.diagonal()).csv());
  if (!result.finished) return interrupted(fmt::format("{} rows are kept", result.points.size()));
  for (const std::string& what : result.left_out) fmt::print(stderr, "touchmark: left out: {}\n", what);
  const papers::Tuned tuned = papers::tune(result, rate);
  support::StandardOutput out;
  out.write(description("as published", tuned.published, options, mesh.diagonal()));
  out.write(description("fast and exact", tuned.fast, options, mesh.diagonal()));
  out.write(reference_note(options, mesh, result));
  out.write(fmt::format("finer levels: none tried, {}\n", search.stopped));
  const std::string rising = papers::rising_error_note(result);
  if (!rising.empty()) out.write(rising + "\n");
  out.write("\n" + table_of(result, mesh.diagonal(), rate));
  return tuned.published || tuned.fast ? support::exit_done : support::exit_check_failed;
}

}  // namespace

void add_tune(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<TuneOptions>();
  CLI::App* command = add_command(program, "tune");
  add_value(*command, "--mesh,mesh", options->mesh, "MESH", "a mesh by name (touchmark list) or a file")
      ->required();
  add_value(*command, "--rate", options->rate, "HZ",
            "queries a second that 99 of 100 must be fast enough for")
      ->required();
  add_list(*command, "--method", options->methods, "METHOD", "of subdivision, repeatable; without it ls3");
  add_value(*command, "--levels", options->levels, "N",
            "up to how many; without it 3, and more while the rate holds");
  add_value(*command, "--reference", options->reference, "MESH",
            "what errors are measured against: a finer mesh of the same object, in the same place; without "
            "it LS3's limit surface, or the mesh itself where it has sharp edges");
  add_value(*command, "--threshold", options->threshold, "LENGTH",
            "only longer edges split: mesh units or % of the diagonal");
  add_list(*command, "--clustering", options->clusterings, "LENGTH",
           "distance, repeatable; without it 0 and half to four times the paper's");
  add_paper_options(*command, options->common);
  command->footer(
      "Exit status 1: nothing tried holds the rate.\nExample: touchmark tune --rate 1000 --mesh bunny\n");
  command->final_callback([options, &context] { context.status = run(context, *options); });
}

}  // namespace touchmark::bench::cli
