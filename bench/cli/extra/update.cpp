/// `touchmark update`: a mesh changes its shape; what does that cost each contestant, against building anew,
/// and are its answers right afterwards?
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/options.h"
#include "bench/cli/run_frame.h"
#include "bench/cli/selected_workload.h"
#include "bench/cli/selector_options.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/roster.h"
#include "bench/experiments/update/update_row.h"
#include "bench/experiments/update/update_run.h"
#include "bench/meshes/meshes.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/split.h"
#include "bench/trajectories/motion_path.h"

namespace touchmark::bench::cli {

namespace update = experiments::update;

namespace {

struct UpdateOptions {
  contestants::Selectors selectors;
  std::string shares = "1%,10%,100%";
  std::string out;
  WorkerSelectors workers;
};

double checked_share(std::string_view text) {
  const double value = support::parse_share(text);
  if (!(value > 0 && value <= 1))
    throw std::invalid_argument(
        fmt::format("--shares: \"{}\" is not a share of the vertices above 0 and at most 100%", text));
  return value;
}

std::string checked_trajectory(const std::vector<std::string>& names) {
  if (names.size() > 1)
    throw std::invalid_argument(
        fmt::format("--trajectory \"{}\" is one too many: update takes one", names[1]));
  return names.empty() ? "slide" : names.front();
}

int run_update(const ProgramContext& context, const UpdateOptions& options) {
  const contestants::CheckedSelectors selection =
      contestants::check(options.selectors, context.roster, &contestants::Forms::updated);
  std::vector<double> shares;
  for (const std::string_view share : support::split(options.shares, ','))
    shares.push_back(checked_share(share));
  const std::string trajectory = checked_trajectory(options.selectors.trajectories);
  workers::WorkerOptions workers = worker_options(options.workers);
  workers.calibrate_clock = false;
  RunFrame frame(context, options.out);
  frame.description.query = selection.queries.front();
  frame.description.seed = selection.seed;
  frame.description.core = workers.core = results::core_for_workers();

  const std::string name = mesh_of(options.selectors);
  frame.progress.show(fmt::format("{}: deforming it", results::without_directories(name)));
  update::UpdateRun run(context.roster, selection.contestants, selection, results::without_directories(name),
                        meshes::load_mesh(name, options.selectors.normalize), shares, trajectory, workers);
  std::vector<update::UpdateRow> rows;
  const bool finished = frame.finishes([&] {
    for (std::size_t i = 0; i < selection.contestants.size(); ++i) {
      const std::vector<update::UpdateRow> more = run.run(i, [&](double share) {
        frame.progress.show(fmt::format("{}, {:g} %: {}", run.workload().mesh_name, 100 * share,
                                        selection.contestants[i].text()));
      });
      rows.insert(rows.end(), more.begin(), more.end());
    }
  });
  support::StandardOutput().write(update::update_table(rows));
  if (frame.folder) {
    frame.folder->write_file("update.csv", update::update_csv(rows));
    frame.folder->write_file("run.json",
                             results::run_json(frame.description, run.workload(), run.contestants()));
  }
  int status = finished ? support::exit_done : interrupted(rows.size());
  for (const update::UpdateRow& row : rows) {
    const bool crashed = row.status.starts_with("crashed") &&
                         context.roster.parse(row.contestant()).claimed == Guarantee::exact;
    if (!row.violates_guarantee() && !crashed) continue;
    if (status == support::exit_done) status = support::exit_check_failed;
    fmt::print(stderr, "touchmark: {} after {:g} % moved: {}\n", row.contestant(), 100 * row.share,
               crashed ? row.status : "answers are not as exact as claimed");
  }
  return status;
}

}  // namespace

void add_update(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<UpdateOptions>();
  CLI::App* command = add_command(program, "update");
  add_selectors(*command, context, options->selectors);
  add_value(*command, "--shares", options->shares, "S,S,...",
            "of the vertices that move: a dent for less than 100%, a wave through all for 100%");
  add_unit(*command, options->selectors.unit);
  add_value(*command, "--out", options->out, "DIR", "folder for update.csv and run.json");
  add_worker_selectors(*command, options->workers);
  command->footer(
      "Updates and builds take turns, in a process for each contestant; afterwards its answers along the\n"
      "trajectory and about what moved are judged by the exact oracle. Exit status 1 if one that claims\n"
      "exactness is wrong or crashes. A contestant without an update of its own is \"unsupported\".\n"
      "Example: touchmark update --mesh bunny --detector sphere-cluster --detector embree --out "
      "out/update\n");
  command->final_callback([options, &context] { context.status = run_update(context, *options); });
}

}  // namespace touchmark::bench::cli
