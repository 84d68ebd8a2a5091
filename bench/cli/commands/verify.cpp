/// `touchmark verify`: every contestant's answers against the oracle; without --mesh on every named mesh,
/// also far from the origin, tiny and huge.
#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/options.h"
#include "bench/cli/program.h"
#include "bench/cli/repeat_command.h"
#include "bench/cli/report_files.h"
#include "bench/cli/reproducers.h"
#include "bench/cli/run_frame.h"
#include "bench/cli/selected_workload.h"
#include "bench/cli/selector_options.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/roster.h"
#include "bench/measurement/comparison.h"
#include "bench/meshes/meshes.h"
#include "bench/results/junit.h"
#include "bench/results/results_csv.h"
#include "bench/results/verification_report.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/system/interrupt.h"
#include "bench/trajectories/trajectories.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::cli {
namespace {

constexpr std::size_t steps_on_each = 200;
constexpr std::size_t steps_on_a_mesh = 2000;
constexpr std::size_t failures_shown = 40;

struct VerifyOptions {
  contestants::Selectors selectors;
  std::string out, reproduce;
  ReportSelectors reports;
  WorkerSelectors workers;
};

/// The scene, or the meshes.
std::vector<std::string> meshes_for(const VerifyOptions& options) {
  if (!options.selectors.scene.empty()) return {options.selectors.scene};
  if (!options.selectors.meshes.empty()) return options.selectors.meshes;
  std::vector<std::string> meshes;
  for (const meshes::NamedMesh& named : meshes::named_meshes()) {
    if (named.example.empty()) continue;
    for (const char* modifier : {"", "@offset=1e6", "@scale=1e-6", "@scale=1e6"})
      meshes.push_back(named.example + modifier);
  }
  return meshes;
}

std::vector<std::string> trajectories_for(const VerifyOptions& options) {
  if (!options.selectors.trajectories.empty()) return options.selectors.trajectories;
  std::vector<std::string> names;
  for (const trajectories::TrajectoryInfo& trajectory : trajectories::trajectories())
    names.push_back(trajectory.name);
  return names;
}

class VerifyRun {
 public:
  VerifyRun(const ProgramContext& context, const VerifyOptions& options)
      : roster_(context.roster),
        options_(options),
        selection_(contestants::check(options.selectors, roster_, contestants::Variety::many)),
        workers_(worker_options(options.workers)),
        frame_(context, options.out),
        junit_(options.reports.junit),
        markdown_(options.reports.markdown) {
    workers_.calibrate_clock = false;
    if (options.reproduce.empty()) return;
    if (!options.selectors.scene.empty())
      throw std::invalid_argument("--reproduce writes scripts about a mesh: name a --mesh, not a --scene");
    reproducers_.emplace(options.reproduce, roster_, workers_);
  }

  int run() {
    frame_.finishes([this] {
      for (const std::string& mesh : meshes_for(options_)) verify_mesh(mesh);
    });
    return report();
  }

 private:
  void verify_mesh(const std::string& mesh) {
    const std::size_t steps = options_.selectors.meshes.empty() ? steps_on_each : steps_on_a_mesh;
    const workload::Workload workload =
        workload_of(options_.selectors, mesh, selection_, trajectories_for(options_), steps);
    measurement::Comparison comparison(roster_, workload, selection_.contestants, workers_,
                                       measurement::accuracy_effort, selection_.seed);
    comparison.set_progress([&](const std::string& trajectory, const std::string& contestant) {
      frame_.progress.show(fmt::format("{}, {}: {}", workload.mesh_name, trajectory, contestant));
    });
    const std::size_t before = rows_.size();
    const auto say_how_to_repeat = [&] {
      for (std::size_t i = before; i < rows_.size(); ++i)
        rows_[i].repeat =
            repeat_command(options_.selectors, mesh, trajectories_for(options_), workload, rows_[i]);
    };
    try {
      comparison.run_all(selection_.queries, rows_);
    } catch (const support::Interrupted&) {
      say_how_to_repeat();
      throw;
    }
    say_how_to_repeat();
    frame_.progress.clear();
    if (reproducers_) reproducers_->add(workload, std::span(rows_).subspan(before));
  }

  int report() {
    const bool finished = frame_.description.finished;
    const std::string failures = results::list_of_failures(rows_, failures_shown);
    const support::Table table = results::verification_table(rows_);
    const std::string judged = results::judged_answers(rows_);
    support::StandardOutput().write(table.text() + judged + (failures.empty() ? "" : "\n" + failures));
    if (finished && junit_.wanted())
      junit_.write(results::junit_xml("touchmark verify", results::cases_of(rows_)));
    if (markdown_.wanted())
      markdown_.write(fmt::format("## touchmark verify{}\n\n{}\n{}{}", finished ? "" : " (interrupted)",
                                  table.markdown(), judged, code_block(failures)));
    if (frame_.folder) frame_.folder->write(results::results_csv(frame_.description.run_id, rows_));
    if (!finished) return interrupted(rows_.size());
    return results::status_of(rows_, std::ranges::any_of(rows_, results::claim_is_broken));
  }

  const contestants::Roster& roster_;
  VerifyOptions options_;
  contestants::CheckedSelectors selection_;
  workers::WorkerOptions workers_;
  RunFrame frame_;
  ReportFile junit_, markdown_;
  std::optional<Reproducers> reproducers_;
  std::vector<measurement::ResultRow> rows_;
};

}  // namespace

void add_verify(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<VerifyOptions>();
  options->selectors.query = "all";
  CLI::App* command = add_command(program, "verify");
  add_selectors(*command, context, options->selectors, contestants::Variety::many);
  add_scene_selectors(*command, options->selectors);
  add_unit(*command, options->selectors.unit);
  add_value(*command, "--out", options->out, "DIR", "folder for results.csv");
  add_value(*command, "--reproduce", options->reproduce, "DIR",
            "folder for scripts that show what plug-ins in Python or JavaScript answer wrongly: one a kind "
            "of fault and mesh, which is cut to the triangles that still show it");
  add_junit(*command, options->reports);
  add_markdown(*command, options->reports);
  add_worker_selectors(*command, options->workers);
  command->footer(
      "Without --mesh: every mesh that needs no file, also at an offset of 1e6 and scaled by 1e-6 and 1e6.\n"
      "With --scene: 200 steps of each trajectory, unless --steps says otherwise; images of triangles are "
      "exact.\n"
      "Exit status 1 if a contestant that claims exactness is wrong, crashes or does not come back; 3 if "
      "memory or\n"
      "another limit of the machine kept one from being judged; 4 if nothing was judged.\n"
      "Example: touchmark verify --mesh bunny --trajectory slide --detector grid-group --radius 0.5%\n"
      "         touchmark verify --scene heap:100:motion=all\n");
  command->final_callback([options, &context] { context.status = VerifyRun(context, *options).run(); });
}

}  // namespace touchmark::bench::cli
