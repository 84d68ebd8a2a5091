/// `touchmark paper park-jang-2018`.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/extra/papers/paper_commands.h"
#include "bench/cli/extra/papers/paper_options.h"
#include "bench/cli/options.h"
#include "bench/cli/program.h"
#include "bench/cli/run_frame.h"
#include "bench/experiments/papers/park_jang/park_jang.h"
#include "bench/experiments/papers/park_jang/park_jang_pictures.h"
#include "bench/results/results_folder.h"
#include "bench/support/checked.h"
#include "bench/support/progress.h"
#include "bench/support/system/denormals.h"
#include "bench/support/system/interrupt.h"
#include "core/search/plane_filter/plane_filter.h"

namespace touchmark::bench::cli {

namespace papers = experiments::papers;

namespace {

struct ParkJangOptions {
  std::vector<std::string> meshes;
  std::string max_groups;
  PaperOptions common{"results/papers/park-jang-2018", "0.1%", "", "1", false};
};

papers::ParkJangSettings checked(const ParkJangOptions& options) {
  const bool quick = options.common.quick;
  papers::ParkJangSettings settings;
  settings.steps = support::count_or(quick ? 20 : 8000, "--steps", options.common.steps, 1, 1'000'000);
  settings.places = std::min<std::size_t>(40, std::max<std::size_t>(settings.steps / 5, 1));
  settings.seed = support::checked_seed(options.common.seed);
  settings.radius = support::checked_length("--radius", options.common.radius);
  settings.groups = papers::park_jang_group_counts(
      support::count_or(quick ? 1000 : 35'000, "--most-groups", options.max_groups, 1, 1'000'000));
  if (quick) settings.effort = {2, 1e5};
  return settings;
}

int run(const ParkJangOptions& options) {
  const papers::ParkJangSettings settings = checked(options);
  const std::vector<papers::PaperMesh> meshes =
      papers::park_jang_meshes(options.meshes, options.common.quick);
  const results::ResultsFolder folder(options.common.out);
  support::watch_for_interrupts();
  support::restore_denormals();
  // Of a mesh between the Stanford resolutions; the groups need a box that can be divided.
  const papers::PaperMesh& pictured = meshes[std::min<std::size_t>(meshes.size() - 1, 2)];
  std::optional<papers::PicturedGroups> shown;
  if (FilterFrame::fits(pictured.mesh.bounds()) && pictured.mesh.diagonal() > 0)
    shown = papers::write_group_pictures(pictured.mesh, settings, folder);
  support::ProgressLine progress;
  papers::ParkJangResult result =
      papers::run_park_jang(meshes, settings, [&](const std::string& what) { progress.show(what); });
  progress.clear();
  if (shown) {
    result.pictured_cubes = shown->cubes;
    result.pictured_spheres = shown->spheres;
  }
  folder.write_file("times.csv", papers::park_jang_times(result).csv());
  folder.write_file("best.csv", papers::park_jang_best_table(result).csv());
  folder.write_file("numbers.csv", papers::claims_table(papers::park_jang_claims(result)).csv());
  folder.write_file("report.md", papers::park_jang_report(meshes, settings, result));
  if (!result.finished) return interrupted(result.rows.size());
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
  add_list(*command, "--mesh", options->meshes, "MESH",
           "a mesh by name or a file, repeatable; without it the bunny at several resolutions");
  add_value(*command, "--most-groups", options->max_groups, "N", "up to how many groups");
  add_paper_options(*command, options->common);
  command->footer(
      "Example: touchmark paper park-jang-2018 --mesh bunny --out results/papers/park-jang-2018\n");
  command->final_callback([options, &context] { context.status = run(*options); });
}

}  // namespace touchmark::bench::cli
