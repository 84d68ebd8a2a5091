/// `touchmark servo`: a paced loop as a haptic device runs it. Does a detector hold the rate, and how surely?
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sched.h>

#include "bench/cli/program.h"
#include "bench/cli/repeat_command.h"
#include "bench/cli/selector_options.h"
#include "bench/cli/worker_options.h"
#include "bench/experiments/servo/real_time_host.h"
#include "bench/experiments/servo/servo_csv.h"
#include "bench/experiments/servo/servo_report.h"
#include "bench/experiments/servo/servo_run.h"
#include "bench/experiments/servo/servo_trace.h"
#include "bench/results/results_folder.h"
#include "bench/results/run_json.h"
#include "bench/scenes/scenes.h"
#include "bench/support/denormals.h"
#include "bench/support/interrupt.h"
#include "bench/support/numbers.h"
#include "bench/support/progress.h"
#include "bench/support/standard_output.h"

namespace touchmark::bench::cli {

namespace servo = experiments::servo;

namespace {

constexpr double max_rate_hz = 100'000;
constexpr double longest_s = 1e6;

struct ServoOptions {
  contestants::Selectors selectors;
  std::string seconds = "10", load = "none", work_us = "0", cpu, out;
  WorkerSelectors workers;
};

double checked_number(const char* option, const std::string& text, bool zero_too, double most) {
  const std::optional<double> value = support::parse_number(text);
  if (!value || !(*value > 0 || (zero_too && *value == 0)) || *value > most)
    throw std::invalid_argument(fmt::format("{} \"{}\" is not a number {} and at most {:g}", option, text,
                                            zero_too ? "of 0 or more" : "above 0", most));
  return *value;
}

int checked_core(const std::string& text) {
  if (text.empty()) return results::core_for_workers().value_or(sched_getcpu());
  const std::optional<std::uint64_t> core = support::parse_count(text);
  cpu_set_t allowed;
  if (!core || *core >= CPU_SETSIZE || sched_getaffinity(0, sizeof allowed, &allowed) != 0 ||
      !CPU_ISSET(static_cast<std::size_t>(*core), &allowed))
    throw std::invalid_argument(fmt::format("--cpu \"{}\" is no core that this program may use", text));
  return static_cast<int>(*core);
}

servo::ServoSettings checked_settings(const ServoOptions& options, int core) {
  servo::ServoSettings settings;
  settings.rate_hz = checked_number("--rate", options.selectors.motion.rate, false, max_rate_hz);
  const double seconds = checked_number("--seconds", options.seconds, false, longest_s);
  settings.ticks = static_cast<std::uint64_t>(std::max(std::round(seconds * settings.rate_hz), 1.0));
  settings.work_us = checked_number("--work", options.work_us, true, 1e6);
  const std::optional<servo::Load> load = servo::load_named(options.load);
  if (!load)
    throw std::invalid_argument(fmt::format("--load \"{}\" is not one of none, memory, cpu", options.load));
  settings.load = *load;
  if (*load != servo::Load::none && servo::other_cores(core).empty())
    throw std::invalid_argument(
        fmt::format("--load {}: there is no other core that this program may use", options.load));
  return settings;
}

std::string checked_trajectory(const std::vector<std::string>& names) {
  if (names.size() > 1)
    throw std::invalid_argument(
        fmt::format("--trajectory \"{}\" is one too many: servo takes one", names[1]));
  return names.empty() ? "slide" : names.front();
}

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
  std::optional<results::ResultsFolder> folder_;
  results::RunDescription description_;
  servo::RealTimeHost host_;
  workload::Workload workload_;
};

ServoCommand::ServoCommand(const ProgramContext& context, const ServoOptions& options)
    : context_(context),
      options_(options),
      core_(checked_core(options.cpu)),
      settings_(checked_settings(options, core_)),
      selection_(contestants::check(options.selectors, context.roster)),
      mesh_(options.selectors.meshes.empty() ? scenes::default_scene() : options.selectors.meshes.front()),
      trajectory_(checked_trajectory(options.selectors.trajectories)),
      description_(results::begun_run(context.argc, context.argv)),
      host_(servo::read_real_time_host(core_)),
      workload_(workload_by_time()) {
  if (!options.out.empty()) folder_.emplace(options.out);
  settings_.seed = description_.seed = selection_.seed;
  description_.flushed_to_zero = support::restore_denormals();
  description_.query = selection_.queries.front();
  description_.core = core_;
  description_.effort = {0, 0, 0, 0};
}

workload::Workload ServoCommand::workload_by_time() {
  TriangleMesh mesh = scenes::load_mesh(mesh_, options_.selectors.normalize);
  static_cast<workload::Selection&>(selection_) =
      servo::selection_by_time(selection_, mesh, trajectory_, settings_.rate_hz);
  return servo::workload_by_time(results::without_directories(mesh_), std::move(mesh), selection_,
                                 trajectory_, settings_);
}

/// The commands that answer a tick's step again: along the file of the positions where `touchmark query` does
/// not make them itself.
void ServoCommand::name_commands(servo::ServoRun& run) const {
  const bool needs_file = servo::is_resampled_shape(trajectory_, settings_.rate_hz);
  if (needs_file && !folder_) return;
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
  auto json = nlohmann::ordered_json::parse(results::run_json(description_, workload_, run.contestants()));
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
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

void ServoCommand::save(const servo::ServoRun& run) const {
  if (!folder_) return;
  folder_->write_file("servo.csv", servo::servo_csv(description_.run_id, settings_, run.rows()));
  folder_->write_file("servo_histogram.csv", servo::histogram_csv(run.rows()));
  folder_->write_file("servo_worst.csv", servo::worst_csv(workload_, run.rows()));
  if (servo::is_resampled_shape(trajectory_, settings_.rate_hz))
    folder_->write_file("motion.csv", servo::motion_csv(workload_));
  folder_->write_file("run.json", run_json(run));
}

int ServoCommand::run() {
  workers::WorkerOptions workers = worker_options(options_.workers);
  workers.core = core_;
  support::ProgressLine progress;
  servo::ServoRun run(context_.roster, workload_, description_.query, selection_.contestants, settings_,
                      workers);
  name_commands(run);
  support::watch_for_interrupts();
  try {
    run.verify([&](const std::string& contestant) { progress.show(contestant + ": verifying it"); });
    run.run(
        [&](std::uint64_t ticks) { progress.show(fmt::format("{} of {} ticks", ticks, settings_.ticks)); });
  } catch (const support::Interrupted&) {
    description_.finished = false;
  }
  progress.clear();
  support::StandardOutput out;
  out.write(servo::circumstances(settings_, workload_, core_, run.rows(), host_) +
            servo::loop_table(settings_, run.rows()) + servo::worst_ticks(workload_, run.rows()));
  save(run);
  if (!description_.finished) {
    fmt::print(stderr, "touchmark: interrupted; there is no verdict on fewer ticks than asked for\n");
    return support::exit_interrupted;
  }
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
  options->selectors.motion.rate = "1000";
  options->selectors.detectors = {"sphere-cluster"};
  CLI::App* command =
      program.add_subcommand("servo", "a paced loop as a device runs it: does a detector hold the rate?");
  add_selectors(*command, context, options->selectors);
  command->get_option("--detector")->capture_default_str();
  command->get_option("--rate")
      ->description("of the loop; motion goes by time, so motion files with times are resampled to it")
      ->capture_default_str();
  command->get_option("--steps")->description(
      "of the trajectory, which is followed to and fro; default: a tick each, at most 20000");
  command
      ->add_option("--seconds", options->seconds,
                   "of each detector's ticks; its idle loop takes as long again")
      ->type_name("S")
      ->capture_default_str();
  command->add_option("--load", options->load, "what the other cores do meanwhile: none, memory or cpu")
      ->type_name("LOAD")
      ->capture_default_str();
  command->add_option("--work", options->work_us, "other work a tick on the same core, after the answer")
      ->type_name("US")
      ->capture_default_str();
  command->add_option("--cpu", options->cpu, "the core of the loop; default: the last")->type_name("N");
  add_unit(*command, options->selectors.unit);
  command->add_option("--out", options->out, "folder for servo.csv and run.json; scripts/plot draws them")
      ->type_name("DIR");
  add_worker_selectors(*command, options->workers);
  command->footer(
      "Each tick is late by the time from its scheduled start to its answer. The same loop with nothing\n"
      "asked takes turns, so that the machine's own misses are known. SCHED_FIFO and locked memory are\n"
      "used where they are allowed. The last line says \"holds\", \"does not hold\" or \"inconclusive\", and "
      "the\n"
      "exit status is 0, 1 or 4.\n"
      "Example: touchmark servo --mesh bunny --detector sphere-cluster --seconds 60 --load memory --out "
      "out/servo\n");
  command->final_callback([options, &context] { context.status = ServoCommand(context, *options).run(); });
}

}  // namespace touchmark::bench::cli
