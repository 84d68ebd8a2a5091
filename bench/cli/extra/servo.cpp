/// `touchmark servo`: a paced loop as a haptic device runs it. Does a detector hold the rate, and how surely?
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/extra/servo_options.h"
#include "bench/cli/repeat_command.h"
#include "bench/cli/run_frame.h"
#include "bench/cli/selected_workload.h"
#include "bench/cli/worker_options.h"
#include "bench/experiments/proxy/proxy_report.h"
#include "bench/experiments/servo/real_time_host.h"
#include "bench/experiments/servo/servo_csv.h"
#include "bench/experiments/servo/servo_report.h"
#include "bench/experiments/servo/servo_run.h"
#include "bench/meshes/meshes.h"
#include "bench/support/files/standard_output.h"
#include "bench/workload/paced_workload.h"

namespace touchmark::bench::cli {

namespace proxy = experiments::proxy;
namespace servo = experiments::servo;

namespace {

nlohmann::ordered_json host_json(const servo::RealTimeHost& host) {
  nlohmann::ordered_json json{{"governor", host.governor},
                              {"deepest_idle_state", host.deepest_idle_state},
                              {"isolated_cores", host.isolated_cores},
                              {"core_is_isolated", host.core_is_isolated},
                              {"huge_pages", host.huge_pages}};
  if (host.wake_up_us) json["wake_up_us"] = *host.wake_up_us;
  if (host.smt) json["smt"] = *host.smt;
  if (host.preempt_rt) json["preempt_rt"] = *host.preempt_rt;
  if (host.real_time_share_us) json["real_time_share_us"] = *host.real_time_share_us;
  return json;
}

class ServoCommand {
 public:
  ServoCommand(const ProgramContext& context, const ServoOptions& options);

  /// Returns an exit status. Throws ResourceError, std::invalid_argument or MeshError.
  int run();

 private:
  /// Fills in what of the selection depends on the trajectory.
  workload::Workload workload_by_time();
  void name_commands(servo::ServoRun& run) const;
  void save(const servo::ServoRun& run) const;
  std::string run_json(const servo::ServoRun& run) const;

  const ProgramContext& context_;
  const ServoOptions& options_;
  int core_;
  servo::ServoSettings settings_;
  contestants::CheckedSelectors selection_;
  std::string mesh_, trajectory_;
  workers::WorkerOptions workers_;
  RunFrame frame_;
  servo::RealTimeHost host_;
  workload::Workload workload_;
};

ServoCommand::ServoCommand(const ProgramContext& context, const ServoOptions& options)
    : context_(context),
      options_(options),
      core_(checked_core(options)),
      settings_(checked_settings(options, core_)),
      selection_(contestants::check(options.selectors, context.roster)),
      mesh_(mesh_of(options.selectors)),
      trajectory_(checked_trajectory(options)),
      workers_(worker_options(options.workers)),
      frame_(context, options.out),
      host_(servo::read_real_time_host(core_)),
      workload_(workload_by_time()) {
  if (settings_.proxy) settings_.proxy->radius = workload_.radius;
  settings_.seed = frame_.description.seed = selection_.seed;
  frame_.description.query = selection_.queries.front();
  frame_.description.core = workers_.core = core_;
  frame_.description.effort = {0, 0, 0, 0};
}

workload::Workload ServoCommand::workload_by_time() {
  const contestants::Selectors& selectors = options_.selectors;
  if (!selectors.scene.empty())
    return workload::scene_workload_by_time(scene_of(selectors), selection_, {trajectory_},
                                            {settings_.rate_hz, settings_.ticks});
  TriangleMesh mesh = meshes::load_mesh(mesh_, selectors.normalize);
  static_cast<workload::Selection&>(selection_) =
      workload::selection_by_time(selection_, mesh, trajectory_, settings_.rate_hz);
  return workload::workload_by_time(results::without_directories(mesh_), std::move(mesh), selection_,
                                    trajectory_, {settings_.rate_hz, settings_.ticks});
}

/// The commands that answer a tick's step again: along the file of the positions where `touchmark query` does
/// not make them itself.
void ServoCommand::name_commands(servo::ServoRun& run) const {
  if (settings_.proxy) return;  // a step follows from all goals before it
  const bool needs_file = workload::is_resampled_shape(trajectory_, settings_.rate_hz);
  if (needs_file && !frame_.folder) return;
  contestants::Selectors selectors = options_.selectors;
  if (!selection_.motion.rate_hz) selectors.motion.rate.clear();
  for (servo::ServoRow& row : run.rows()) {
    measurement::ResultRow of;
    of.detector = row.detector;
    of.options = row.options;
    of.trajectory = row.trajectory;
    of.query = row.query;
    row.repeat = repeat_command(selectors, mesh_, {needs_file ? options_.out + "/motion.csv" : trajectory_},
                                workload_, of);
  }
}

std::string ServoCommand::run_json(const servo::ServoRun& run) const {
  auto json =
      nlohmann::ordered_json::parse(results::run_json(frame_.description, workload_, run.contestants()));
  std::string scheduler, memory;
  for (const servo::ServoRow& row : run.rows()) {
    if (row.scheduler.empty()) continue;
    scheduler = row.scheduler;
    memory = row.memory;
  }
  json["servo"] = {{"rate_hz", settings_.rate_hz},
                   {"ticks", settings_.ticks},
                   {"stretch_ticks", servo::ticks_a_stretch(settings_)},
                   {"load", servo::name_of(settings_.load)},
                   {"work_us", settings_.work_us},
                   {"scheduler", scheduler},
                   {"memory", memory},
                   {"verdict", servo::name_of(servo::verdict_on_all(run.rows()))},
                   {"host", host_json(host_)}};
  if (settings_.proxy) {
    json["query"] = servo::proxy_step;
    json["servo"]["proxy"] = proxy::coupling_json(*settings_.proxy);
    json["servo"]["proxy"]["method"] = servo::own_proxy;
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

void ServoCommand::save(const servo::ServoRun& run) const {
  if (!frame_.folder) return;
  frame_.folder->write_file("servo.csv", servo::servo_csv(frame_.description.run_id, settings_, run.rows()));
  frame_.folder->write_file("servo_histogram.csv", servo::histogram_csv(run.rows()));
  frame_.folder->write_file("servo_worst.csv", servo::worst_csv(workload_, run.rows()));
  if (workload::is_resampled_shape(trajectory_, settings_.rate_hz))
    frame_.folder->write_file("motion.csv", workload::motion_csv(workload_));
  frame_.folder->write_file("run.json", run_json(run));
}

int ServoCommand::run() {
  if (options_.load.empty() && settings_.load == servo::Load::none)
    fmt::print(stderr, "touchmark: load none: there is no other core that this program may use\n");
  servo::ServoRun run(context_.roster, workload_, frame_.description.query, selection_.contestants, settings_,
                      workers_);
  name_commands(run);
  const bool finished = frame_.finishes([&] {
    run.verify([&](const std::string& contestant) { frame_.progress.show(contestant + ": verifying it"); });
    run.run([&](std::uint64_t ticks) {
      frame_.progress.show(fmt::format("{} of {} ticks", ticks, settings_.ticks));
    });
  });
  support::StandardOutput out;
  out.write(servo::circumstances(settings_, workload_, core_, run.rows(), host_) +
            servo::loop_table(settings_, run.rows()) + servo::worst_ticks(workload_, run.rows()));
  save(run);
  if (!finished) return interrupted("there is no verdict on fewer ticks than asked for");
  out.write(servo::verdict_lines(settings_, run.rows()));
  switch (servo::verdict_on_all(run.rows())) {
    case servo::Verdict::holds:
      return support::exit_done;
    case servo::Verdict::does_not_hold:
      return support::exit_check_failed;
    case servo::Verdict::inconclusive:
      break;
  }
  return support::exit_inconclusive;
}

}  // namespace

void add_servo(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<ServoOptions>();
  CLI::App* command = add_command(program, "servo");
  add_servo_options(*command, context, *options);
  command->footer(
      "Each tick is late by the time from its scheduled start to its answer. The same loop with nothing\n"
      "asked takes turns, so that the machine's own misses are known. SCHED_FIFO and locked memory are\n"
      "used where they are allowed. The last line says \"holds\", \"does not hold\" or \"inconclusive\", and "
      "the\n"
      "exit status is 0, 1 or 4.\n"
      "Example: touchmark servo --mesh bunny --detector sphere-cluster --seconds 60 --out out/servo\n");
  command->final_callback([options, &context] { context.status = ServoCommand(context, *options).run(); });
}

}  // namespace touchmark::bench::cli
