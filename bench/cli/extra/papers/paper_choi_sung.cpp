/// `touchmark paper choi-sung-2017`.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/extra/papers/paper_commands.h"
#include "bench/cli/extra/papers/paper_options.h"
#include "bench/cli/options.h"
#include "bench/cli/program.h"
#include "bench/cli/run_frame.h"
#include "bench/experiments/papers/choi_sung/choi_sung.h"
#include "bench/experiments/papers/choi_sung/choi_sung_models.h"
#include "bench/experiments/papers/choi_sung/choi_sung_report.h"
#include "bench/experiments/papers/choi_sung/contact_levels.h"
#include "bench/experiments/papers/frontier.h"
#include "bench/experiments/papers/paper_report.h"
#include "bench/experiments/papers/picture_files.h"
#include "bench/results/results_folder.h"
#include "bench/support/checked.h"
#include "bench/support/progress.h"
#include "bench/support/system/denormals.h"
#include "bench/support/system/interrupt.h"

namespace touchmark::bench::cli {

namespace papers = experiments::papers;

namespace {

struct ChoiSungOptions {
  std::string mesh, levels;
  std::string clustering = fmt::format("{}%", papers::choi_sung_clustering_percent);
  PaperOptions common{"results/papers/choi-sung-2017", "0.5%", "", "1", false};
};

papers::ChoiSungSettings checked(const ChoiSungOptions& options, const TriangleMesh& mesh) {
  const bool quick = options.common.quick;
  papers::ChoiSungSettings settings;
  settings.levels = static_cast<int>(support::count_or(3, "--levels", options.levels, 1, 5));
  settings.steps = support::count_or(quick ? 50 : 2000, "--steps", options.common.steps, 1, 1'000'000);
  settings.seed = support::checked_seed(options.common.seed);
  settings.radius = support::checked_length("--radius", options.common.radius).in_mesh_units(mesh);
  settings.clustering = support::checked_length("--clustering", options.clustering).in_mesh_units(mesh);
  if (!(settings.clustering > 0)) throw support::bad_value("--clustering", options.clustering, "above 0");
  if (quick) settings.effort = {2, 1e5};
  return settings;
}

papers::FrontierSettings frontier_settings(const papers::ChoiSungSettings& settings, const TriangleMesh& mesh,
                                           bool quick) {
  papers::FrontierSettings frontier;
  frontier.levels = settings.levels;
  frontier.threshold = papers::choi_sung_threshold_percent / 100 * mesh.diagonal();
  frontier.clusterings = {0, settings.clustering};
  frontier.radius = settings.radius;
  frontier.seed = settings.seed;
  frontier.effort = settings.effort;
  if (quick) {
    frontier.levels = 1;
    frontier.steps = settings.steps;
    frontier.samples = 50;
  } else {
    for (const double times : {0.5, 2.0, 4.0}) frontier.clusterings.push_back(times * settings.clustering);
  }
  return frontier;
}

papers::ContactLevelSettings contact_level_settings(const papers::ChoiSungSettings& settings, bool quick) {
  papers::ContactLevelSettings levels;
  levels.levels = quick ? 1 : settings.levels;
  levels.clustering = settings.clustering;
  levels.radius = settings.radius;
  levels.seed = settings.seed;
  if (quick) {
    levels.steps = settings.steps;
    levels.rates = 3;
    levels.rounds = 2;
  }
  return levels;
}

class Run {
 public:
  explicit Run(const ChoiSungOptions& options)
      : mesh_(papers::choi_sung_mesh(options.mesh)),
        settings_(checked(options, mesh_.mesh)),
        frontier_(frontier_settings(settings_, mesh_.mesh, options.common.quick)),
        contact_levels_(contact_level_settings(settings_, options.common.quick)),
        folder_(options.common.out),
        models_(options.common.quick ? std::vector<papers::Model>() : papers::choi_sung_models()) {}

  int run() {
    support::watch_for_interrupts();
    support::restore_denormals();
    const auto keep_pictures = [this](const papers::SurfaceMeasures& surface, const TriangleMesh& mesh,
                                      const SphereClusters& single, const SphereClusters& clustered) {
      const std::string name = fmt::format("pictures/{}-{}", surface.method, surface.level);
      folder_.write_file(name + "-mesh.csv", papers::triangles_csv(mesh));
      folder_.write_file(name + "-spheres.csv", papers::spheres_csv(single.spheres));
      folder_.write_file(name + "-clustered.csv", papers::spheres_csv(clustered.spheres));
    };
    const papers::PrintProgress print_progress = [this](const std::string& what) { progress_.show(what); };
    papers::ChoiSungResult result =
        papers::run_choi_sung(mesh_.mesh, settings_, keep_pictures, print_progress);
    papers::FrontierResult frontier;
    papers::ContactLevelResult levels;
    write_tables(result, frontier, levels);
    if (result.finished) frontier = papers::run_frontier(mesh_.mesh, frontier_, print_progress);
    papers::add_distances(frontier, result);
    if (frontier.finished) levels = papers::run_contact_levels(mesh_.mesh, contact_levels_, print_progress);
    if (levels.finished)
      papers::add_models(models_, settings_, mesh_.mesh.diagonal(), result, print_progress);
    progress_.clear();
    write_tables(result, frontier, levels);
    return levels.finished ? finish(result) : interrupted(result.rows.size() + frontier.points.size());
  }

 private:
  void write_tables(const papers::ChoiSungResult& result, const papers::FrontierResult& frontier,
                    const papers::ContactLevelResult& levels) const {
    const bool own = papers::is_choi_sungs_bunny(mesh_.mesh);
    const support::Table claims = papers::claims_table(papers::choi_sung_claims(result, own));
    folder_.write_file("table1.csv", papers::choi_sung_table1(result).csv());
    folder_.write_file("table2.csv", papers::choi_sung_table2(result).csv());
    folder_.write_file("table3.csv", papers::choi_sung_table3(result).csv());
    folder_.write_file("distances.csv", papers::choi_sung_distances(result).csv());
    folder_.write_file("models.csv", papers::choi_sung_models(result).csv());
    folder_.write_file("fast_forms.csv", papers::choi_sung_fast_table(result).csv());
    folder_.write_file("numbers.csv", claims.csv());
    folder_.write_file("tool_counts.csv",
                       papers::claims_table(papers::choi_sung_tool_counts(result, own)).csv());
    folder_.write_file("report.md", papers::choi_sung_report(mesh_, settings_, result, frontier, levels));
    if (!frontier.points.empty())
      folder_.write_file("frontier.csv", papers::frontier_table(frontier, mesh_.mesh.diagonal()).csv());
    if (levels.finished)
      folder_.write_file("levels.csv", papers::contact_levels_table(levels, mesh_.mesh.diagonal()).csv());
  }

  int finish(const papers::ChoiSungResult& result) const {
    fmt::print("{}\n",
               papers::summary(papers::choi_sung_claims(result, papers::is_choi_sungs_bunny(mesh_.mesh))));
    if (!papers::is_choi_sungs_bunny(mesh_.mesh))
      fmt::print(
          "These counts are of {}, not of the paper's mesh: docs/papers.md says where that comes from and "
          "where to put it.\n",
          mesh_.name);
    if (result.answers_agree) return support::exit_done;
    fmt::print(stderr, "touchmark: the exact forms answer differently on some surface (table1.csv)\n");
    return support::exit_check_failed;
  }

  papers::PaperMesh mesh_;
  papers::ChoiSungSettings settings_;
  papers::FrontierSettings frontier_;
  papers::ContactLevelSettings contact_levels_;
  results::ResultsFolder folder_;
  std::vector<papers::Model> models_;
  support::ProgressLine progress_;
};

}  // namespace

void add_paper_choi_sung(CLI::App& paper_command, ProgramContext& context) {
  const auto options = std::make_shared<ChoiSungOptions>();
  CLI::App* command = paper_command.add_subcommand(
      "choi-sung-2017", "subdivision and sphere clustering: Tables 1 to 3 and what the figures show");
  add_value(*command, "--mesh", options->mesh, "MESH",
            "level 0: a mesh by name or a file; without it the paper's bunny, or one decimated to its size");
  add_value(*command, "--levels", options->levels, "N", "of subdivision (3, as in the paper)");
  add_value(*command, "--clustering", options->clustering, "LENGTH",
            "distance: mesh units or % of the box diagonal");
  add_paper_options(*command, options->common);
  command->footer("Example: touchmark paper choi-sung-2017 --out results/papers/choi-sung-2017\n");
  command->final_callback([options, &context] { context.status = Run(*options).run(); });
}

}  // namespace touchmark::bench::cli
