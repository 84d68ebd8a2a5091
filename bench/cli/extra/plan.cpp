/// `touchmark plan`: a sweep as a manifest of jobs, for `touchmark run` on one machine or many.
#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/batch/manifest.h"
#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/options.h"
#include "bench/cli/plugin_option.h"
#include "bench/cli/selector_options.h"
#include "bench/contestants/roster.h"
#include "bench/meshes/meshes.h"
#include "bench/results/build_info.h"
#include "bench/support/checked.h"
#include "bench/support/files/atomic_file.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/progress.h"
#include "bench/workload/content_hash.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::cli {
namespace {

struct PlanOptions {
  std::vector<std::string> meshes, trajectories, detectors, plugins, queries, radii, reaches, seeds;
  std::string steps, effort = "full", out;
  bool normalize = false;
  contestants::MotionSelectors motion;
};

std::vector<workload::Query> checked_queries(const std::vector<std::string>& names) {
  std::vector<workload::Query> queries;
  for (const std::string& name : names) {
    const std::optional<workload::Query> query = workload::query_named(name);
    if ((!query && name != "all") || query == workload::Query::moving)
      throw support::bad_value("--query", name, "one of touches, nearest, sweep, all");
    if (query) queries.push_back(*query);
    if (name == "all")
      queries.insert(queries.end(), workload::all_queries.begin(), workload::all_queries.end());
  }
  return queries.empty() ? std::vector{workload::Query::nearest} : queries;
}

class Planner {
 public:
  Planner(const contestants::Roster& roster, const PlanOptions& options)
      : roster_(roster), options_(options), queries_(checked_queries(options.queries)) {
    batch::effort_named(options.effort);
    manifest_.version = results::build_info().version;
    manifest_.effort = options.effort;
    for (const std::string& file : options.plugins) manifest_.plugins.push_back(batch::plugin_of(file));
  }

  batch::Manifest plan() {
    for (const std::string& mesh : or_else(options_.meshes, {meshes::default_mesh()})) plan_mesh(mesh);
    return std::move(manifest_);
  }

 private:
  void plan_mesh(const std::string& mesh) {
    const TriangleMesh loaded = meshes::load_mesh(mesh, options_.normalize);
    contestants::Selectors selectors;
    selectors.detectors = options_.detectors;
    selectors.steps = options_.steps;
    selectors.motion = options_.motion;
    for (const std::string& radius : or_else(options_.radii, {selectors.radius})) {
      for (const std::string& reach : or_else(options_.reaches, {""})) {
        for (const std::string& seed : or_else(options_.seeds, {selectors.seed})) {
          selectors.radius = radius;
          selectors.reach = reach;
          selectors.seed = seed;
          plan_traces(mesh, loaded, selectors);
        }
      }
    }
  }

  void plan_traces(const std::string& mesh, const TriangleMesh& loaded,
                   const contestants::Selectors& selectors) {
    const contestants::CheckedSelectors selection = contestants::check(selectors, roster_);
    const std::vector<std::string> trajectories =
        or_else(options_.trajectories, {"slide", "approach", "hover", "jump"});
    progress_.show(fmt::format("{}, radius {}, seed {}", mesh, selectors.radius, selectors.seed));
    const std::size_t default_steps = options_.effort == "quick" ? 5000 : 20000;
    const workload::Workload workload =
        workload::make_workload(mesh, loaded, selection, trajectories, default_steps);
    for (std::size_t i = 0; i < trajectories.size(); ++i) {
      for (const workload::Query query : queries_) {
        batch::BatchMesh planned{mesh,
                                 options_.normalize,
                                 workload::hash_of(loaded),
                                 trajectories[i],
                                 workload::hash_of(workload.traces[i]),
                                 workload.traces[i].size(),
                                 selection.seed,
                                 selectors.radius,
                                 selectors.reach,
                                 query,
                                 {},
                                 options_.motion};
        add_mesh(std::move(planned), selection.contestants);
      }
    }
  }

  /// A job that was planned before, by its content, is not planned again.
  void add_mesh(batch::BatchMesh planned, const std::vector<contestants::ContestantSpec>& contestants) {
    for (const contestants::ContestantSpec& contestant : contestants) {
      const std::string id =
          batch::job_id(planned, batch::identity_of(contestant), manifest_.effort, manifest_.version);
      if (ids_.insert(id).second) planned.jobs.push_back({id, contestant.text()});
    }
    if (!planned.jobs.empty()) manifest_.meshes.push_back(std::move(planned));
  }

  const contestants::Roster& roster_;
  const PlanOptions& options_;
  std::vector<workload::Query> queries_;
  batch::Manifest manifest_;
  std::set<std::string> ids_;
  support::ProgressLine progress_;
};

void run(const contestants::Roster& roster, const PlanOptions& options) {
  const batch::Manifest manifest = Planner(roster, options).plan();
  if (options.out.empty()) {
    support::StandardOutput().write(manifest.json());
    return;
  }
  support::AtomicFile file(options.out);
  file.write(manifest.json());
  file.commit();
  fmt::print(stderr, "touchmark: {} jobs in {} scenes\n", manifest.jobs(), manifest.meshes.size());
}

}  // namespace

void add_plan(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<PlanOptions>();
  CLI::App* command = add_command(program, "plan");
  const auto many = [command](const char* name, std::vector<std::string>& values, const char* what,
                              const char* type) {
    add_list(*command, name, values, type, fmt::format("{}; repeatable", what));
  };
  many("--mesh", options->meshes, "a mesh by name (touchmark list) or a file", "MESH");
  many("--trajectory", options->trajectories, "a name (touchmark list) or a motion file, CSV", "T");
  many("--detector", options->detectors, "a contestant (touchmark list); default: those of bench", "D");
  add_plugins(*command, context, &options->detectors);
  many("--query", options->queries, "touches, nearest, sweep or all; default: nearest", "QUERY");
  many("--radius", options->radii, "the probe's; default: 0.5%", "LENGTH");
  many("--reach", options->reaches, "how far nearest looks; default: the radius", "LENGTH");
  many("--seed", options->seeds, "of trajectories and of the order of measuring; default: 1", "N");
  add_motion_selectors(*command, options->motion);
  command->add_flag("--normalize", options->normalize, "scale meshes to box diagonal 1 about the origin");
  add_value(*command, "--steps", options->steps, "N", "steps a trajectory");
  add_value(*command, "--effort", options->effort, "WORD",
            "full, quick, or accuracy: verified only, so that many may run side by side");
  add_value(*command, "--out", options->out, "FILE", "file for the manifest; default: standard output");
  command->footer(
      "Example: touchmark plan --mesh bunny --mesh dragon:3 --radius 0.5% --radius 2% --query all --out "
      "sweep.json\n"
      "         touchmark run --manifest sweep.json --shard 1/1 --out jobs && touchmark merge jobs --out "
      "results.csv\n");
  command->final_callback([options, command, &context] {
    options->plugins = plugins_given(*command);
    run(context.roster, *options);
  });
}

}  // namespace touchmark::bench::cli
