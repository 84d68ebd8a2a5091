/// `touchmark paper choi-sung-2017`.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/commands/paper_commands.h"
#include "bench/cli/program.h"
#include "bench/experiments/papers/choi_sung.h"
#include "bench/experiments/papers/choi_sung_report.h"
#include "bench/experiments/papers/frontier.h"
#include "bench/experiments/papers/paper_options.h"
#include "bench/experiments/papers/paper_report.h"
#include "bench/experiments/papers/picture_files.h"
#include "bench/results/results_folder.h"
#include "bench/support/denormals.h"
#include "bench/support/interrupt.h"
#include "bench/support/progress.h"

namespace touchmark::bench {
namespace {

struct ChoiSungOptions {
  std::string mesh, levels;
  std::string clustering = fmt::format("{}%", choi_sung_clustering_percent);
  PaperOptions common{"results/papers/choi-sung-2017", "0.5%", "", "1", false};
};

ChoiSungSettings checked(const ChoiSungOptions& options, const TriangleMesh& mesh) {
  const bool quick = options.common.quick;
  ChoiSungSettings settings;
  settings.levels = static_cast<int>(checked_number("--levels", options.levels, 1, 5, 3));
  settings.steps = checked_number("--steps", options.common.steps, 1, 1'000'000, quick ? 50 : 2000);
  settings.seed = checked_seed(options.common.seed);
  settings.radius = checked_finite_length("--radius", options.common.radius).in_mesh_units(mesh);
  settings.clustering = checked_finite_length("--clustering", options.clustering).in_mesh_units(mesh);
  if (!(settings.clustering > 0))
    throw std::invalid_argument(fmt::format("--clustering \"{}\" is not above 0", options.clustering));
  if (quick) settings.effort = {2, 1e5};
  return settings;
}

FrontierSettings frontier_settings(const ChoiSungSettings& settings, const TriangleMesh& mesh, bool quick) {
  FrontierSettings frontier;
  frontier.levels = settings.levels;
  frontier.threshold = choi_sung_threshold_percent / 100 * mesh.diagonal();
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

class Run {
 public:
  Run(const ChoiSungOptions& options, PaperMesh mesh)
      : mesh_(std::move(mesh)),
        settings_(checked(options, mesh_.mesh)),
        frontier_(frontier_settings(settings_, mesh_.mesh, options.common.quick)),
        folder_(options.common.out) {}

  int run() {
    watch_for_interrupts();
    restore_denormals();
    const auto keep_pictures = [this](const SurfaceMeasures& surface, const TriangleMesh& mesh,
                                      const SphereClusters& single, const SphereClusters& clustered) {
      const std::string name = fmt::format("pictures/{}-{}", surface.method, surface.level);
      folder_.write_file(name + "-mesh.csv", triangles_csv(mesh));
      folder_.write_file(name + "-spheres.csv", spheres_csv(single.spheres));
      folder_.write_file(name + "-clustered.csv", spheres_csv(clustered.spheres));
    };
    const PrintProgress print_progress = [this](const std::string& what) { progress_.show(what); };
    const ChoiSungResult result = run_choi_sung(mesh_.mesh, settings_, keep_pictures, print_progress);
    FrontierResult frontier;
    write_tables(result, frontier);
    if (result.finished) frontier = run_frontier(mesh_.mesh, frontier_, print_progress);
    progress_.clear();
    write_tables(result, frontier);
    if (!frontier.finished) {
      fmt::print(stderr, "touchmark: interrupted; {} finished rows are kept\n",
                 result.rows.size() + frontier.points.size());
      return exit_interrupted;
    }
    return finish(result);
  }

 private:
  void write_tables(const ChoiSungResult& result, const FrontierResult& frontier) const {
    const bool own = is_choi_sungs_bunny(mesh_.mesh);
    const Table claims = claims_table(choi_sung_claims(result, own));
    folder_.write_file("table1.csv", choi_sung_table1(result).csv());
    folder_.write_file("table2.csv", choi_sung_table2(result).csv());
    folder_.write_file("table3.csv", choi_sung_table3(result).csv());
    folder_.write_file("fast_forms.csv", choi_sung_fast_table(result).csv());
    folder_.write_file("numbers.csv", claims.csv());
    folder_.write_file("tool_counts.csv", claims_table(choi_sung_tool_counts(result, own)).csv());
    folder_.write_file("report.md", choi_sung_report(mesh_, settings_, result, frontier));
    if (!frontier.points.empty())
      folder_.write_file("frontier.csv", frontier_table(frontier, mesh_.mesh.diagonal()).csv());
  }

  int finish(const ChoiSungResult& result) const {
    fmt::print("{}\n", summary(choi_sung_claims(result, is_choi_sungs_bunny(mesh_.mesh))));
    if (result.answers_agree) return exit_done;
    fmt::print(stderr, "touchmark: the exact forms answer differently on some surface (table1.csv)\n");
    return exit_check_failed;
  }

  PaperMesh mesh_;
  ChoiSungSettings settings_;
  FrontierSettings frontier_;
  ResultsFolder folder_;
  ProgressLine progress_;
};

}  // namespace

void add_paper_choi_sung(CLI::App& paper_command, ProgramContext& context) {
  const auto options = std::make_shared<ChoiSungOptions>();
  CLI::App* command = paper_command.add_subcommand(
      "choi-sung-2017", "subdivision and sphere clustering: Tables 1 to 3 and what the figures show");
  command
      ->add_option(
          "--mesh", options->mesh,
          "level 0: a scene or a mesh file; without it the paper's bunny, or one decimated to its size")
      ->type_name("MESH");
  command->add_option("--levels", options->levels, "of subdivision (3, as in the paper)")->type_name("N");
  command->add_option("--clustering", options->clustering, "distance: mesh units or % of the box diagonal")
      ->type_name("LENGTH")
      ->capture_default_str();
  add_paper_options(*command, options->common);
  command->footer("Example: touchmark paper choi-sung-2017 --out results/papers/choi-sung-2017\n");
  command->final_callback([options, &context] {
    Run run(*options, choi_sung_mesh(options->mesh));
    context.status = run.run();
  });
}

}  // namespace touchmark::bench
