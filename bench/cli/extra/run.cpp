/// `touchmark run`: one shard of a planned sweep. What is finished is not run again.
#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/batch/job_file.h"
#include "bench/batch/manifest.h"
#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/options.h"
#include "bench/cli/plugin_option.h"
#include "bench/cli/run_frame.h"
#include "bench/cli/worker_options.h"
#include "bench/measurement/comparison.h"
#include "bench/results/build_info.h"
#include "bench/results/results_csv.h"
#include "bench/support/checked.h"
#include "bench/support/numbers.h"
#include "bench/workload/content_hash.h"

namespace touchmark::bench::cli {
namespace {

struct RunOptions {
  std::string manifest, shard = "1/1", out;
  WorkerSelectors workers;
};

struct Shard {
  std::size_t which = 1;  ///< from 1
  std::size_t count = 1;

  bool has(std::size_t index) const { return index % count == which - 1; }
};

Shard checked_shard(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size() - 1);
  const std::uint64_t which = support::parse_count(text.substr(0, slash)).value_or(0);
  const std::uint64_t count = support::parse_count(text.substr(slash + 1)).value_or(0);
  if (which < 1 || which > count) throw support::bad_value("--shard", text, "i/N, i from 1 to N");
  return {which, count};
}

void expect_planned(const std::string& what, const std::string& name, std::uint64_t then, std::uint64_t now) {
  if (then == now) return;
  throw std::invalid_argument(fmt::format(
      "{} \"{}\" is not the one that was planned: fnv1a {:016x}, not {:016x}", what, name, now, then));
}

class BatchRun {
 public:
  BatchRun(ProgramContext& context, const RunOptions& options)
      : context_(context),
        options_(options),
        manifest_(batch::Manifest::read(options.manifest)),
        shard_(checked_shard(options.shard)),
        effort_(batch::effort_named(manifest_.effort)),
        frame_(context, "") {
    frame_.folder.emplace(options.out);  // which also refuses an empty name
    if (manifest_.version != results::build_info().version)
      throw std::invalid_argument(fmt::format("{}: planned by version {}, this is {}: plan it anew",
                                              options.manifest, manifest_.version,
                                              results::build_info().version));
    load_planned_plugins(context);
  }

  int run() {
    const bool finished = frame_.finishes([this] {
      for (std::size_t index = 0; index < manifest_.meshes.size(); ++index)
        if (shard_.has(index)) run_mesh(manifest_.meshes[index]);
    });
    fmt::print(stderr, "touchmark: {}shard {}: {} jobs done, {} were finished before\n",
               finished ? "" : "interrupted; ", options_.shard, done_, skipped_);
    return finished ? support::exit_done : support::exit_interrupted;
  }

 private:
  void load_planned_plugins(ProgramContext& context) const {
    for (const batch::BatchPlugin& plugin : manifest_.plugins) {
      expect_planned("plug-in", plugin.file, plugin.hash, batch::plugin_of(plugin.file).hash);
      load_plugins(context, {plugin.file});
    }
  }

  void run_mesh(const batch::BatchMesh& planned) {
    const std::vector<contestants::ContestantSpec> missing = missing_of(planned);
    skipped_ += planned.jobs.size() - missing.size();
    if (missing.empty()) return;
    if (missing.size() < planned.jobs.size() && effort_.repetitions > 0) {
      frame_.progress.clear();
      fmt::print(stderr,
                 "touchmark: {}, {}: {} of {} jobs were finished before; the others get another run_id: "
                 "compare times within one\n",
                 planned.mesh, planned.trajectory, planned.jobs.size() - missing.size(), planned.jobs.size());
    }
    const workload::Workload workload = planned_workload(planned);
    results::RunDescription description = description_of(planned);
    workers::WorkerOptions workers = worker_options(options_.workers);
    workers.core = description.core;
    workers.calibrate_clock = effort_.repetitions > 0;
    measurement::Comparison comparison(context_.roster, workload, missing, workers, effort_, planned.seed);
    comparison.set_progress([&](const std::string& trajectory, const std::string& contestant) {
      frame_.progress.show(fmt::format("{}, {}: {}", workload.mesh_name, trajectory, contestant));
    });
    const std::vector<measurement::ResultRow> rows = comparison.run(0, planned.query);
    description.steadiness = comparison.steadiness();
    const auto run =
        nlohmann::json::parse(results::run_json(description, workload, comparison.contestants()));
    for (const measurement::ResultRow& row : rows) {
      const std::string id =
          batch::job_id(planned, batch::identity_of(context_.roster.parse(row.contestant())),
                        manifest_.effort, manifest_.version);
      const batch::JobResult job{id, results::machine_fingerprint(), run,
                                 results::fields_of(results::results_columns(), row, description.run_id)};
      frame_.folder->write_file(batch::job_path("", id), job.json());
      ++done_;
    }
  }

  std::vector<contestants::ContestantSpec> missing_of(const batch::BatchMesh& planned) const {
    std::vector<contestants::ContestantSpec> missing;
    for (const batch::BatchJob& job : planned.jobs) {
      contestants::ContestantSpec spec = context_.roster.parse(job.detector);
      if (batch::job_id(planned, batch::identity_of(spec), manifest_.effort, manifest_.version) != job.id)
        throw std::invalid_argument(
            fmt::format("{}: job {} does not have the id of what it describes", options_.manifest, job.id));
      if (!batch::is_finished(options_.out, job.id)) missing.push_back(std::move(spec));
    }
    return missing;
  }

  workload::Workload planned_workload(const batch::BatchMesh& planned) const {
    workload::Workload workload = batch::workload_of(planned, context_.roster);
    expect_planned("mesh", planned.mesh, planned.mesh_hash, workload::hash_of(workload.mesh));
    expect_planned("trajectory", planned.trajectory, planned.trace_hash,
                   workload::hash_of(workload.traces.front()));
    return workload;
  }

  results::RunDescription description_of(const batch::BatchMesh& planned) const {
    results::RunDescription description = results::begun_run(context_.argc, context_.argv);
    description.query = planned.query;
    description.seed = planned.seed;
    description.effort = effort_;
    // Runs that only verify may go side by side, and would all sit on that one core.
    if (effort_.repetitions > 0) description.core = results::core_for_workers();
    return description;
  }

  const ProgramContext& context_;
  const RunOptions& options_;
  batch::Manifest manifest_;
  Shard shard_;
  measurement::Effort effort_;
  RunFrame frame_;
  std::size_t skipped_ = 0, done_ = 0;
};

}  // namespace

void add_run(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = add_command(program, "run");
  add_value(*command, "--manifest", options->manifest, "FILE", "what touchmark plan wrote")->required();
  add_value(*command, "--shard", options->shard, "i/N",
            "the i-th of N parts; all rivals of a mesh are in one part, and timed in one run");
  add_value(*command, "--out", options->out, "DIR",
            "folder for one file a job; finished ones are not run again")
      ->required();
  add_worker_selectors(*command, options->workers);
  command->footer(
      "May be stopped and started again. Mesh and trajectory files are found from the current folder, as "
      "they\n"
      "were when the sweep was planned.\n"
      "Example: touchmark run --manifest sweep.json --shard 3/8 --out jobs\n");
  command->final_callback([options, &context] { context.status = BatchRun(context, *options).run(); });
}

}  // namespace touchmark::bench::cli
