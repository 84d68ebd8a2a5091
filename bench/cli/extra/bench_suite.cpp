#include "bench/cli/extra/bench_suite.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/cli/options.h"
#include "bench/cli/run_frame.h"
#include "bench/contestants/roster.h"
#include "bench/experiments/suite/suite_csv.h"
#include "bench/experiments/suite/suite_plan.h"
#include "bench/experiments/suite/suite_report.h"
#include "bench/experiments/suite/suite_score.h"
#include "bench/experiments/suite/suite_workload.h"
#include "bench/measurement/comparison.h"
#include "bench/meshes/meshes.h"
#include "bench/results/report_table.h"
#include "bench/results/results_csv.h"
#include "bench/support/checked.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/numbers.h"
#include "bench/support/system/interrupt.h"

namespace touchmark::bench::cli {

namespace suite = experiments::suite;

namespace {

constexpr std::size_t losses_shown = 40, uncounted_shown = 40;
constexpr std::chrono::milliseconds build_timeout{60'000}, request_timeout{10'000};

/// How much of the suite is measured, and how thoroughly.
struct Extent {
  std::uint64_t triangles;
  std::size_t cells;
  std::size_t steps;
  double about_minutes;        ///< on two cores, with every rival
  measurement::Effort effort;  ///< its cold passes are of the cold cells only
  double minutes = std::numeric_limits<double>::infinity();
};

const Extent usual_extent{60'000, 6, 6000, 25, {8, 3, 8e6, 4e6}};
const Extent quick_extent{9'000, 2, 2000, 1.5, {5, 3, 3e6, 1.5e6}};
constexpr std::size_t usual_cold_samples = 100;

std::size_t checked_cells(const std::string& text) {
  const std::size_t most = suite::every_cell().size();
  if (text == "all") return most;
  const std::optional<std::uint64_t> cells = support::parse_count(text);
  if (!cells || *cells < 1 || *cells > most)
    throw support::bad_value("--cells", text, fmt::format("a whole number from 1 to {}, or all", most));
  return *cells;
}

Extent extent_of(const SuiteOptions& options) {
  Extent extent = options.quick ? quick_extent : usual_extent;
  if (!options.cells.empty()) extent.cells = checked_cells(options.cells);
  if (!options.minutes.empty())
    extent.minutes = support::checked_positive("--minutes", options.minutes, support::Infinity::allowed);
  if (options.cold_samples)
    extent.effort.take_all_cold(*options.cold_samples);
  else if (!options.quick)
    extent.effort.take_all_cold(usual_cold_samples);
  return extent;
}

contestants::CheckedSelectors checked(const contestants::Selectors& selectors,
                                      const contestants::Roster& roster) {
  contestants::CheckedSelectors selection = contestants::check(selectors, roster, &contestants::Forms::suite);
  const auto is_ours = [&](const contestants::ContestantSpec& spec) { return roster.find(spec.name).ours; };
  if (std::ranges::none_of(selection.contestants, is_ours))
    throw std::invalid_argument("--suite: no --detector is one of ours");
  return selection;
}

class SuiteRun {
 public:
  SuiteRun(const ProgramContext& context, const SuiteOptions& options)
      : roster_(context.roster),
        options_(options),
        extent_(extent_of(options)),
        selection_(checked(options.selectors, context.roster)),
        plan_(suite::make_plan(or_else(options.selectors.meshes, suite::suite_meshes(extent_.triangles)),
                               extent_.cells, selection_.seed, extent_.effort.cold_passes > 0)),
        workers_(worker_options(options.workers)),
        frame_(context, options.out) {
    if (options.workers.timeout.empty()) {
      workers_.build_timeout = build_timeout;
      workers_.request_timeout = request_timeout;
    }
    extent_.steps = selection_.steps.value_or(extent_.steps);
    frame_.description.seed = selection_.seed;
    frame_.description.effort = extent_.effort;
    frame_.description.core = workers_.core = results::core_for_workers();
  }

  /// An exit status. Throws ResourceError, std::invalid_argument or MeshError.
  int run() {
    out_.write(fmt::format("suite: {} scenes, {} cells of {}, {}\n", plan_.meshes.size(), plan_.cells(),
                           plan_.meshes.size() * suite::every_cell().size(), duration_text()));
    out_.finish();
    const bool finished = frame_.finishes([this] {
      for (const suite::SuiteMesh& planned : plan_.meshes) run_mesh(planned);
    });
    if (!finished) {
      for (std::size_t i = runs_.size(); i < plan_.meshes.size(); ++i)
        add_unmeasured(plan_.meshes[i], results::without_directories(plan_.meshes[i].mesh));
      save(false);
    }
    out_.write('\n' + suite::summary_table(scored_) + '\n' + suite::list_of_losses(scored_, losses_shown));
    const std::string uncounted = suite::list_of_uncounted(scored_, uncounted_shown);
    if (!uncounted.empty()) out_.write('\n' + uncounted);
    out_.finish();
    if (!finished) return interrupted(rows_.size());
    const auto where = [](const measurement::ResultRow& row) { return row.mesh + ", " + row.trajectory; };
    return results::print_faults(rows_, where) ? support::exit_check_failed : support::exit_done;
  }

 private:
  /// Every mesh has its share of the time, and what one leaves over is for those after it.
  void run_mesh(const suite::SuiteMesh& planned) {
    frame_.progress.show(
        fmt::format("{}: making the mesh and the trajectories{}", planned.mesh, time_left()));
    const double left = extent_.minutes - minutes();
    const double until = minutes() + left / static_cast<double>(plan_.meshes.size() - meshes_done_);
    const suite::MeshWorkload made =
        suite::workload_of(planned, meshes::load_mesh(planned.mesh, options_.selectors.normalize),
                           extent_.steps, selection_.seed);
    frame_.progress.show(fmt::format("{}: preparing the oracle{}", made.workload.mesh_name, time_left()));
    measurement::Comparison comparison(roster_, made.workload, selection_.contestants, workers_,
                                       frame_.description.effort, selection_.seed);
    comparison.set_progress([&](const std::string& trajectory, const std::string& contestant) {
      frame_.progress.show(fmt::format("{} of {}, {}, {}: {}{}", meshes_done_ + 1, plan_.meshes.size(),
                                       made.workload.mesh_name, trajectory, contestant, time_left()));
    });
    std::vector<suite::MeasuredCell> measured;
    for (const suite::SuiteCell& cell : planned.cells)
      measured.push_back({made.workload.mesh_name, made.workload.mesh.size(), cell, {}});
    try {
      for (std::size_t i = 0; i < planned.cells.size() && (i == 0 || minutes() < until); ++i)
        run_cell(comparison, made, i, measured[i]);
    } catch (const support::Interrupted&) {
      finish_mesh(comparison, made, std::move(measured));
      throw;
    }
    cells_done_ += planned.cells.size();
    ++meshes_done_;
    finish_mesh(comparison, made, std::move(measured));
  }

  void run_cell(measurement::Comparison& comparison, const suite::MeshWorkload& made, std::size_t which,
                suite::MeasuredCell& measured) {
    measurement::Effort effort = extent_.effort;
    if (!measured.cell.l2) effort.cold_passes = 0;
    if (!measured.cell.cold) effort.cold_samples = 0;
    comparison.set_effort(effort);
    measured.rows = comparison.run(made.trace_of[which], measured.cell.query);
    measured.conclusive = comparison.steadiness().empty() || comparison.steadiness().back().conclusive();
  }

  void finish_mesh(const measurement::Comparison& comparison, const suite::MeshWorkload& made,
                   std::vector<suite::MeasuredCell> measured) {
    const std::vector<std::string> names = ours();
    for (suite::MeasuredCell& cell : measured) {
      std::ranges::move(
          suite::score(cell, names, [&](const std::string& detector) { return is_ours(detector); }),
          std::back_inserter(scored_));
      std::ranges::move(cell.rows, std::back_inserter(rows_));
    }
    frame_.description.steadiness = comparison.steadiness();
    runs_.push_back(results::run_json(frame_.description, made.workload, comparison.contestants()));
    save(meshes_done_ == plan_.meshes.size());
  }

  /// The cells of a mesh that was not begun.
  void add_unmeasured(const suite::SuiteMesh& planned, const std::string& mesh) {
    for (const suite::SuiteCell& cell : planned.cells)
      std::ranges::move(suite::score({mesh, 0, cell, {}}, ours(), [](const std::string&) { return true; }),
                        std::back_inserter(scored_));
  }

  void save(bool finished) const {
    if (!frame_.folder || runs_.empty()) return;
    frame_.folder->write(results::results_csv(frame_.description.run_id, rows_), run_json(finished));
    frame_.folder->write_file("suite.csv",
                              suite::suite_csv(frame_.description.run_id, frame_.description.seed, scored_));
  }

  /// The trajectories of all meshes, and what the suite adds.
  std::string run_json(bool finished) const {
    auto json = nlohmann::ordered_json::parse(results::joined_run_json(runs_, finished));
    auto trajectories = nlohmann::ordered_json::array();
    for (const std::string& run : runs_) {
      const auto parsed = nlohmann::ordered_json::parse(run);
      for (const auto& one : parsed.at("trajectories"))
        if (std::ranges::find(trajectories, one) == trajectories.end()) trajectories.push_back(one);
    }
    json["trajectories"] = trajectories;
    json["queries"] = {"touches", "nearest", "sweep"};
    json.erase("asked");  // not every motion with every query
    json["suite"] = {{"scenes", plan_.meshes.size()},
                     {"cells", plan_.cells()},
                     {"cells_of_a_scene", suite::every_cell().size()},
                     {"minutes", nlohmann::ordered_json(extent_.minutes)},
                     {"steps", extent_.steps}};
    if (!(extent_.minutes < 1e9)) json["suite"]["minutes"] = "inf";
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
  }

  std::vector<std::string> ours() const {
    std::vector<std::string> names;
    for (const contestants::ContestantSpec& spec : selection_.contestants)
      if (is_ours(spec.name)) names.push_back(spec.text());
    return names;
  }

  bool is_ours(const std::string& detector) const { return roster_.find(detector).ours; }
  double minutes() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() / 60;
  }
  std::string time_left() const {
    if (cells_done_ == 0) return "";
    const double left =
        minutes() / static_cast<double>(cells_done_) * static_cast<double>(plan_.cells() - cells_done_);
    return fmt::format(", about {:.0f} min left", std::min(left, std::max(extent_.minutes - minutes(), 0.0)));
  }

  std::string duration_text() const {
    if (std::isfinite(extent_.minutes)) return fmt::format("at most about {:g} minutes", extent_.minutes);
    const Extent& planned = options_.quick ? quick_extent : usual_extent;
    const bool is_usual = options_.selectors.meshes.empty() && options_.cells.empty();
    return is_usual ? fmt::format("all of them measured, in about {:g} minutes on two cores",
                                  planned.about_minutes)
                    : "all of them measured";
  }

  const contestants::Roster& roster_;
  const SuiteOptions& options_;
  Extent extent_;
  contestants::CheckedSelectors selection_;
  suite::SuitePlan plan_;
  workers::WorkerOptions workers_;
  RunFrame frame_;
  support::StandardOutput out_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::size_t meshes_done_ = 0, cells_done_ = 0;
  std::vector<measurement::ResultRow> rows_;
  std::vector<suite::SuiteRow> scored_;
  std::vector<std::string> runs_;  // run.json of each mesh
};

}  // namespace

int run_suite(const ProgramContext& context, const SuiteOptions& options) {
  return SuiteRun(context, options).run();
}

}  // namespace touchmark::bench::cli
