/// `touchmark scale`: how build, first answer, memory and query time grow with the mesh. The comparison of
/// `touchmark bench` on one mesh after the other, and power laws through its rows.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/extra/scale_bodies.h"
#include "bench/cli/options.h"
#include "bench/cli/run_frame.h"
#include "bench/cli/selector_options.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/roster.h"
#include "bench/experiments/scaling/growth.h"
#include "bench/experiments/scaling/mesh_sizes.h"
#include "bench/measurement/comparison.h"
#include "bench/meshes/meshes.h"
#include "bench/results/report_table.h"
#include "bench/results/results_csv.h"
#include "bench/support/checked.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/system/available_memory.h"
#include "bench/trajectories/trajectories.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::cli {

namespace scaling = experiments::scaling;

namespace {

constexpr const char* default_sizes = "1k,10k,100k,1M,10M";
constexpr const char* quick_sizes = "1k,10k,100k";
constexpr std::chrono::milliseconds default_build_timeout{600'000};
/// What a contestant may take while it is built: a guess, more than twice what the largest keeps.
constexpr double bytes_per_triangle = 1500;

struct ScaleOptions {
  contestants::Selectors selectors;
  std::string sizes, limit = "60", shrink, out;
  bool bodies = false, quick = false;
  WorkerSelectors workers;
};

scaling::Shrinks checked_shrinks(const std::string& text) {
  using scaling::Shrinks;
  for (const Shrinks shrinks : {Shrinks::nothing, Shrinks::reach, Shrinks::reach_and_motion})
    if (text == scaling::name_of(shrinks)) return shrinks;
  throw std::invalid_argument(fmt::format("--shrink \"{}\" is neither reach nor all", text));
}

/// Returns a trajectory that moves at this part of its speed, if it is generated and has one of its own.
std::string slowed(const std::string& trajectory, double part) {
  for (const trajectories::TrajectoryInfo& known : trajectories::trajectories())
    if (known.own_percent > 0 && known.name == trajectory)
      return fmt::format("{}:speed={}%", trajectory, known.own_percent * part);
  return trajectory;
}

class ScaleRun {
 public:
  ScaleRun(const ProgramContext& context, const ScaleOptions& options)
      : roster_(context.roster),
        options_(options),
        selection_(contestants::check(options.selectors, context.roster, &contestants::Forms::scaled)),
        limit_s_(support::checked_positive("--limit-seconds", options.limit, support::Infinity::allowed)),
        shrinks_(checked_shrinks(options.shrink)),
        meshes_(scaling::meshes_of_sizes(or_else(options.selectors.meshes, {"noisy-sphere"}), options.sizes,
                                         options.quick ? quick_sizes : default_sizes)),
        workers_(worker_options(options.workers)),
        frame_(context, options.out) {
    // A name that is wrong should not be found out after the smaller meshes.
    for (const std::string& mesh : meshes_)
      if (!scaling::comes_in_sizes(scaling::family_of(mesh)))
        meshes::load_mesh(mesh, options.selectors.normalize);
    if (options.workers.timeout.empty()) workers_.build_timeout = default_build_timeout;
    frame_.description.query = selection_.queries.front();
    frame_.description.seed = selection_.seed;
    if (options.quick) frame_.description.effort = measurement::quick_effort;
    frame_.description.core = workers_.core = results::core_for_workers();
  }

  /// An exit status. Throws ResourceError, std::invalid_argument or MeshError.
  int run() {
    const bool finished = frame_.finishes([this] {
      for (const std::string& mesh : meshes_) run_mesh(mesh);
    });
    out_.write(scaling::growth_table(scaling::growth_of(rows_, shrinks_)));
    if (!finished) return interrupted(fmt::format("the rows of {} finished meshes are kept", runs_.size()));
    const auto where = [](const measurement::ResultRow& row) { return row.mesh + ", " + row.trajectory; };
    return results::print_faults(rows_, where) ? support::exit_check_failed : support::exit_done;
  }

 private:
  void run_mesh(const std::string& name) {
    frame_.progress.show(fmt::format("{}: making the mesh and the trajectories", name));
    const contestants::Selectors& selectors = options_.selectors;
    const std::vector<std::string> asked = or_else(selectors.trajectories, {"slide"});
    TriangleMesh mesh = meshes::load_mesh(name, selectors.normalize);
    contestants::CheckedSelectors selection = selection_;
    std::vector<std::string> moves = asked;
    if (shrinks_ != scaling::Shrinks::nothing) {
      const double part = edges_of_first(name, mesh);
      selection.radius.value *= part;
      if (selection.reach) selection.reach->value *= part;
      if (shrinks_ == scaling::Shrinks::reach_and_motion)
        for (std::string& move : moves) move = slowed(move, part);
    }
    workload::Workload workload = workload::make_workload(results::without_directories(name), std::move(mesh),
                                                          selection, moves, options_.quick ? 5000 : 20000);
    // One curve, whatever speed it has on this mesh.
    for (std::size_t i = 0; i < asked.size(); ++i)
      if (moves[i] != asked[i]) workload.trajectories[i] = asked[i];
    frame_.progress.show(fmt::format("{}: preparing the oracle", name));
    measurement::Comparison comparison(roster_, workload, selection_.contestants, workers_,
                                       frame_.description.effort, selection_.seed);
    comparison.set_schedule(schedule_for(workload));
    comparison.set_progress([&](const std::string& trajectory, const std::string& contestant) {
      frame_.progress.show(fmt::format("{}, {}: {}", workload.mesh_name, trajectory, contestant));
    });
    skip_known(comparison, workload.mesh.size());
    std::vector<measurement::ResultRow> rows;
    for (std::size_t trace = 0; trace < workload.traces.size(); ++trace)
      std::ranges::move(run_trace(comparison, workload, trace), std::back_inserter(rows));
    note_too_much(comparison, rows);
    std::ranges::move(rows, std::back_inserter(rows_));
    frame_.description.steadiness = comparison.steadiness();
    runs_.push_back(results::run_json(frame_.description, workload, comparison.contestants()));
    save(runs_.size() == meshes_.size());
  }

  /// Returns the edges of a surface of so many triangles over those of the first of its family.
  double edges_of_first(const std::string& name, const TriangleMesh& mesh) {
    const auto triangles = static_cast<double>(mesh.size());
    const auto first = first_triangles_.try_emplace(scaling::family_of(name), triangles).first;
    return std::sqrt(first->second / triangles);
  }

  std::vector<measurement::ResultRow> run_trace(measurement::Comparison& comparison,
                                                const workload::Workload& workload, std::size_t trace) {
    std::vector<measurement::ResultRow> rows = comparison.run(trace, frame_.description.query);
    frame_.progress.clear();
    out_.write(fmt::format("\n{}, {} ({})\n{}{}", workload.mesh_name, workload.trajectories[trace],
                           workload::trace_text(workload, trace), results::comparison_text(rows),
                           results::verdict(rows, comparison.steadiness().back())));
    out_.finish();
    return rows;
  }

  void skip_known(measurement::Comparison& comparison, std::size_t triangles) {
    for (const contestants::ContestantSpec& spec : selection_.contestants) {
      const auto found = too_much_.find(spec.text());
      if (found == too_much_.end() || found->second.triangles >= triangles) continue;
      comparison.skip(spec, found->second.status);
      frame_.progress.clear();
      fmt::print(stderr, "touchmark: {}: {}\n", spec.text(), found->second.status);
    }
  }

  /// Contestants that took too long, and those that did not get through at all.
  void note_too_much(const measurement::Comparison& comparison,
                     const std::vector<measurement::ResultRow>& rows) {
    const auto note = [&](const std::string& contestant, const std::string& why) {
      const measurement::ResultRow& row = rows.front();
      too_much_.try_emplace(contestant,
                            TooMuch{row.triangles, fmt::format("skipped: {} on {}", why, row.mesh)});
    };
    for (const measurement::ResultRow& row : rows)
      if (row.status != "ok" && row.status != "unsupported" && !row.status.starts_with("skipped"))
        note(row.contestant(), row.status);
    for (const workers::ContestantProcess& process : comparison.contestants())
      if (process.busy_s() > limit_s_)
        note(process.spec().text(), fmt::format("took {:.3g} s", process.busy_s()));
  }

  /// All at once while there is room, so that times of one mesh compare as those of `touchmark bench` do.
  measurement::Schedule schedule_for(const workload::Workload& workload) const {
    const double all = bytes_per_triangle * static_cast<double>(workload.mesh.size()) *
                       static_cast<double>(selection_.contestants.size());
    const std::optional<std::uint64_t> available = support::available_memory();
    return available && all > static_cast<double>(*available) / 2 ? measurement::Schedule::sequential
                                                                  : measurement::Schedule::interleaved;
  }

  void save(bool finished) const {
    if (!frame_.folder) return;
    frame_.folder->write(results::results_csv(frame_.description.run_id, rows_),
                         results::joined_run_json(runs_, finished));
    frame_.folder->write_file("scaling.csv", scaling::scaling_csv(scaling::growth_of(rows_, shrinks_)));
  }

  /// The smallest mesh that was too much for a contestant.
  struct TooMuch {
    std::size_t triangles = 0;
    std::string status;  ///< for the rows of larger ones
  };

  const contestants::Roster& roster_;
  const ScaleOptions& options_;
  contestants::CheckedSelectors selection_;
  double limit_s_;
  scaling::Shrinks shrinks_;
  std::vector<std::string> meshes_;
  std::map<std::string, double> first_triangles_;  // by family
  workers::WorkerOptions workers_;
  RunFrame frame_;
  support::StandardOutput out_;
  std::map<std::string, TooMuch> too_much_;  // by contestant
  std::vector<measurement::ResultRow> rows_;
  std::vector<std::string> runs_;  // run.json of each mesh
};

}  // namespace

void add_scale(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<ScaleOptions>();
  CLI::App* command = add_command(program, "scale");
  add_selectors(*command, context, options->selectors);
  command->get_option("--mesh")->take_all()->description(
      "noisy-sphere (the default) or soup in each of the sizes, dragon in its resolutions, or a mesh as it "
      "is; repeatable");
  add_value(*command, "--sizes", options->sizes, "N,N,...",
            fmt::format("numbers of triangles; default: {}, with --quick {}", default_sizes, quick_sizes));
  add_value(*command, "--limit-seconds", options->limit, "S",
            "a contestant that took longer on a mesh is left out on larger ones");
  add_value(*command, "--shrink", options->shrink, "WHAT",
            "reach: radius and reach are as given on the smallest mesh, and shrink as the edges of its "
            "triangles do; all: so does the speed of motion");
  command->add_flag(
      "--bodies", options->bodies,
      "scenes of 1 body and of each of the sizes instead, with motions still, one, drift and all");
  add_unit(*command, options->selectors.unit);
  add_value(*command, "--out", options->out, "DIR", "folder for results.csv, scaling.csv and run.json");
  command->add_flag("--quick", options->quick, "fewer sizes, steps and repetitions");
  add_worker_selectors(*command, options->workers);
  command->footer(
      "Fits quantity = factor * triangles^exponent to build time, first answer, memory and query time of\n"
      "each contestant, and tells what the query time is made of: looks, their kinds, the time of a look.\n"
      "With --shrink what the reach and the motion add to it can be told apart. scripts/plot DIR draws "
      "them.\n"
      "With --bodies: what a tick costs, in free space and beside a body, what placing a moved body does, "
      "and\n"
      "the bytes of a body, by the number of bodies; into bodies.csv, bodies_growth.csv and run.json. All\n"
      "contestants run in this program, and their answers are compared with the first one's.\n"
      "Example: touchmark scale --bodies --sizes 10,100,1k,10k,100k --detector sphere-cluster --out "
      "out/bodies\n"
      "Example: touchmark scale --sizes 1k,10k,100k,1M --detector grid-group --detector embree --out "
      "out/scaling\n");
  command->final_callback([options, &context] {
    context.status = options->bodies
                         ? run_scale_bodies(context, {options->selectors, options->sizes, options->limit,
                                                      options->out, options->quick})
                         : ScaleRun(context, *options).run();
  });
}

}  // namespace touchmark::bench::cli
