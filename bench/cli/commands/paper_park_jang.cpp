/// `touchmark paper park-jang-2018`.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/commands/paper_commands.h"
#include "bench/cli/program.h"
#include "bench/experiments/papers/paper_options.h"
#include "bench/experiments/papers/paper_trace.h"
#include "bench/experiments/papers/park_jang.h"
#include "bench/experiments/papers/picture_files.h"
#include "bench/results/results_folder.h"
#include "bench/support/denormals.h"
#include "bench/support/interrupt.h"
#include "bench/support/progress.h"
#include "core/grid_group/published/scan_grid.h"
#include "core/search/plane_filter.h"

namespace touchmark::bench::cli {

namespace papers = experiments::papers;

namespace {

struct ParkJangOptions {
  std::vector<std::string> meshes;
  std::string max_groups;
  papers::PaperOptions common{"results/papers/park-jang-2018", "0.1%", "", "1", false};
};

papers::ParkJangSettings checked(const ParkJangOptions& options) {
  const bool quick = options.common.quick;
  papers::ParkJangSettings settings;
  settings.steps = papers::checked_number("--steps", options.common.steps, 1, 1'000'000, quick ? 20 : 200);
  settings.seed = papers::checked_seed(options.common.seed);
  settings.radius = papers::checked_finite_length("--radius", options.common.radius);
  settings.groups = papers::park_jang_group_counts(
      papers::checked_number("--most-groups", options.max_groups, 1, 1'000'000, quick ? 1000 : 35'000));
  if (quick) settings.effort = {2, 1e5};
  return settings;
}

/// Figs 4 to 6: the model, its groups, and the triangles of one group that holds a probe on the surface.
class GroupPictures {
 public:
  GroupPictures(const papers::PaperMesh& mesh, const papers::ParkJangSettings& settings,
                const results::ResultsFolder& folder)
      : mesh_(mesh), folder_(folder) {
    const double radius = settings.radius.in_mesh_units(mesh.mesh);
    hip_ = papers::paper_trace("slide", mesh.mesh, 1, settings.seed, radius).front().probe.center;
  }

  void write() const {
    folder_.write_file("pictures/original-mesh.csv", papers::triangles_csv(mesh_.mesh));
    const auto cubes = groups(grid::Shape::cube, papers::park_jang_cubes);
    folder_.write_file("pictures/cube-groups.csv", papers::boxes_csv(cubes.boxes()));
    write_active("cube", cubes,
                 [&](std::size_t group) { return cubes.boxes()[group].squared_distance(hip_); });
    const auto spheres = groups(grid::Shape::sphere, papers::park_jang_spheres);
    folder_.write_file("pictures/sphere-groups.csv", papers::spheres_csv(spheres.spheres()));
    write_active("sphere", spheres, [&](std::size_t group) {
      const Sphere& sphere = spheres.spheres()[group];
      return (sphere.center - hip_).norm() - sphere.radius;
    });
    folder_.write_file("pictures/hip.csv", fmt::format("x,y,z\n{},{},{}\n", hip_.x(), hip_.y(), hip_.z()));
  }

 private:
  /// Cells come in steps, so a few sizes about the right one are tried for exactly as many groups.
  grid::ScanGrid groups(grid::Shape shape, std::size_t count) const {
    const auto miss = [count](const grid::ScanGrid& grid) {
      return grid.groups() > count ? grid.groups() - count : count - grid.groups();
    };
    grid::ScanGrid best = grid::ScanGrid::build(mesh_.mesh, {.shape = shape, .groups = count});
    const double cell = best.cell();
    for (int i = 1; i <= 60 && miss(best) > 0; ++i) {
      const double part = (i % 2 == 0 ? 0.002 : -0.002) * ((i + 1) / 2);
      grid::ScanGrid next = grid::ScanGrid::build(mesh_.mesh, {.shape = shape, .cell = cell * (1 + part)});
      if (miss(next) < miss(best)) best = std::move(next);
    }
    return best;
  }

  /// The group that the probe is deepest in.
  template <class Gap>
  void write_active(const char* shape, const grid::ScanGrid& grid, const Gap& gap) const {
    std::size_t active = 0;
    for (std::size_t group = 1; group < grid.groups(); ++group) {
      if (gap(group) < gap(active)) active = group;
    }
    folder_.write_file(fmt::format("pictures/{}-active.csv", shape),
                       papers::triangles_csv(mesh_.mesh, grid.members(active)));
  }

  const papers::PaperMesh& mesh_;
  const results::ResultsFolder& folder_;
  Vec3 hip_;
};

int run(const ParkJangOptions& options) {
  const papers::ParkJangSettings settings = checked(options);
  const std::vector<papers::PaperMesh> meshes =
      papers::park_jang_meshes(options.meshes, options.common.quick);
  const results::ResultsFolder folder(options.common.out);
  support::watch_for_interrupts();
  support::restore_denormals();
  // Of a mesh between the Stanford resolutions; the groups need a box that can be divided.
  const papers::PaperMesh& pictured = meshes[std::min<std::size_t>(meshes.size() - 1, 2)];
  if (FilterFrame::fits(pictured.mesh.bounds()) && pictured.mesh.diagonal() > 0)
    GroupPictures(pictured, settings, folder).write();
  support::ProgressLine progress;
  const papers::ParkJangResult result =
      papers::run_park_jang(meshes, settings, [&](const std::string& what) { progress.show(what); });
  progress.clear();
  folder.write_file("times.csv", papers::park_jang_times(result).csv());
  folder.write_file("best.csv", papers::park_jang_best_table(result).csv());
  folder.write_file("numbers.csv", papers::claims_table(papers::park_jang_claims(result)).csv());
  folder.write_file("report.md", papers::park_jang_report(meshes, settings, result));
  if (!result.finished) {
    fmt::print(stderr, "touchmark: interrupted; {} finished rows are kept\n", result.rows.size());
    return support::exit_interrupted;
  }
  fmt::print("{}\n", papers::summary(papers::park_jang_claims(result)));
  if (result.answers_agree) return support::exit_done;
  fmt::print(stderr, "touchmark: the forms answer differently on some mesh (times.csv)\n");
  return support::exit_check_failed;
}

}  // namespace

void add_paper_park_jang(CLI::App& paper_command, ProgramContext& context) {
  const auto options = std::make_shared<ParkJangOptions>();
  CLI::App* command = paper_command.add_subcommand(
      "park-jang-2018", "time against the number of groups, cubes and spheres (Fig. 7)");
  command
      ->add_option("--mesh", options->meshes,
                   "a scene or a mesh file, repeatable; without it the bunny at several resolutions")
      ->type_name("MESH")
      ->expected(1)
      ->take_all();
  command->add_option("--most-groups", options->max_groups, "up to how many groups")->type_name("N");
  papers::add_paper_options(*command, options->common);
  command->footer(
      "Example: touchmark paper park-jang-2018 --mesh bunny --out results/papers/park-jang-2018\n");
  command->final_callback([options, &context] { context.status = run(*options); });
}

}  // namespace touchmark::bench::cli
