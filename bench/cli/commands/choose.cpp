/// `touchmark choose`: which detector, with which options, for this part on this machine?
#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/bodies/scene_source.h"
#include "bench/cli/program.h"
#include "bench/cli/selector_options.h"
#include "bench/cli/worker_options.h"
#include "bench/experiments/choose/candidate.h"
#include "bench/experiments/choose/choose_code.h"
#include "bench/experiments/choose/choose_csv.h"
#include "bench/experiments/choose/choose_motions.h"
#include "bench/experiments/choose/choose_report.h"
#include "bench/measurement/comparison.h"
#include "bench/results/results_csv.h"
#include "bench/results/results_folder.h"
#include "bench/results/run_json.h"
#include "bench/scenes/scenes.h"
#include "bench/support/denormals.h"
#include "bench/support/interrupt.h"
#include "bench/support/numbers.h"
#include "bench/support/progress.h"
#include "bench/support/standard_output.h"

namespace touchmark::bench::cli {

namespace choose = experiments::choose;

namespace {

struct ChooseOptions {
  contestants::Selectors selectors;
  std::vector<std::string> motions;
  std::string share = "10%", memory, out;
  bool quick = false;
  WorkerSelectors workers;
};

double checked_rate(const std::string& text) {
  constexpr double max_rate_hz = 100'000;
  const std::optional<double> rate = support::parse_number(text);
  if (!rate || !(*rate > 0) || *rate > max_rate_hz)
    throw std::invalid_argument(
        fmt::format("--rate \"{}\" is not a number above 0 and at most {:g}", text, max_rate_hz));
  return *rate;
}

/// 10% or 0.1.
double checked_share(std::string text) {
  const std::string given = text;
  const bool percent = text.ends_with('%');
  if (percent) text.pop_back();
  const std::optional<double> value = support::parse_number(text);
  const double share = value.value_or(0) / (percent ? 100 : 1);
  if (!(share > 0) || share > 1)
    throw std::invalid_argument(
        fmt::format("--share \"{}\" is not a part of a tick: above 0 and at most 100%, or 1", given));
  return share;
}

/// 50MB, 800KB, 2GB or bytes; by thousands, as tables write them.
std::optional<double> checked_memory(const std::string& given) {
  if (given.empty()) return std::nullopt;
  std::string text = given;
  double unit = 1;
  for (const auto& [suffix, bytes] : {std::pair{"KB", 1e3}, std::pair{"MB", 1e6}, std::pair{"GB", 1e9}}) {
    if (!text.ends_with(suffix)) continue;
    text.resize(text.size() - 2);
    unit = bytes;
    break;
  }
  const std::optional<double> value = support::parse_number(text);
  if (!value || !(*value > 0) || *value * unit > 1e15)
    throw std::invalid_argument(
        fmt::format("--memory \"{}\" is not a size above 0: bytes, or as 800KB, 50MB or 2GB", given));
  return *value * unit;
}

std::vector<std::string> motions_of(const ChooseOptions& options) {
  std::vector<std::string> motions = options.motions;
  motions.insert(motions.end(), options.selectors.trajectories.begin(), options.selectors.trajectories.end());
  if (!motions.empty()) return motions;
  return options.selectors.scene.empty() ? choose::usual_motions() : choose::usual_motions_over_bodies();
}

measurement::Effort effort_for(bool quick) {
  measurement::Effort effort;
  if (quick) effort = measurement::quick_effort;
  effort.repetitions = 3;
  effort.cold_passes = quick ? 1 : 2;
  effort.cold_samples = quick ? 20 : measurement::samples_for_p99;
  effort.cold_l2_samples = 2 * effort.min_cold_samples;
  effort.cold_budget_ns = 0.2e9;
  // A decision by the largest of few samples would be one by the machine's other work.
  if (!quick) effort.min_cold_samples = effort.cold_samples / effort.cold_passes;
  return effort;
}

class ChooseCommand {
 public:
  ChooseCommand(const ProgramContext& context, const ChooseOptions& options);

  /// Returns an exit status. Throws ResourceError, std::invalid_argument or MeshError.
  int run();

 private:
  choose::Asked asked() const { return {workload_, description_.query, limits_}; }
  const contestants::ContestantSpec& spec_of(const choose::Candidate& candidate) const;
  std::string code(const std::vector<std::size_t>& ranked) const;
  void measure();
  void save(const measurement::Comparison& comparison) const;
  std::string run_json(const measurement::Comparison& comparison) const;
  int report() const;

  const ProgramContext& context_;
  const ChooseOptions& options_;
  choose::Limits limits_;
  contestants::CheckedSelectors selection_;
  std::optional<results::ResultsFolder> folder_;
  results::RunDescription description_;
  workload::Workload workload_;
  std::vector<std::vector<measurement::ResultRow>> rows_;  // by motion
  std::vector<choose::Candidate> candidates_;
};

workload::Workload workload_for(const ChooseOptions& options, const workload::Selection& selection,
                                double rate_hz) {
  const contestants::Selectors& selectors = options.selectors;
  if (!selectors.scene.empty())
    return choose::workload_by_time(
        bodies::load_body_scene(selectors.scene, selectors.poses, selectors.packages), selection,
        motions_of(options), rate_hz);
  const std::string mesh =
      options.selectors.meshes.empty() ? scenes::default_scene() : options.selectors.meshes.front();
  return choose::workload_by_time(results::without_directories(mesh),
                                  scenes::load_mesh(mesh, options.selectors.normalize), selection,
                                  motions_of(options), rate_hz);
}

ChooseCommand::ChooseCommand(const ProgramContext& context, const ChooseOptions& options)
    : context_(context),
      options_(options),
      limits_{checked_rate(options.selectors.motion.rate), checked_share(options.share),
              checked_memory(options.memory)},
      selection_(contestants::check(options.selectors, context.roster)),
      description_(results::begun_run(context.argc, context.argv)),
      workload_(workload_for(options, selection_, limits_.rate_hz)) {
  if (!options.out.empty()) folder_.emplace(options.out);
  description_.query = selection_.queries.front();
  if (options.selectors.detectors.empty())
    selection_.contestants = options.selectors.scene.empty()
                                 ? context.roster.candidates(description_.query)
                                 : context.roster.scene_candidates(description_.query);
  description_.flushed_to_zero = support::restore_denormals();
  description_.seed = selection_.seed;
  description_.effort = effort_for(options.quick);
  description_.core = results::core_for_workers();
}

const contestants::ContestantSpec& ChooseCommand::spec_of(const choose::Candidate& candidate) const {
  return *std::find_if(
      selection_.contestants.begin(), selection_.contestants.end(),
      [&](const contestants::ContestantSpec& spec) { return spec.text() == candidate.contestant(); });
}

/// Returns the recommended one's; where that is no class of the library, also that of the best one that is.
std::string ChooseCommand::code(const std::vector<std::size_t>& ranked) const {
  std::string text;
  for (const std::size_t i : ranked) {
    const contestants::ContestantSpec& spec = spec_of(candidates_[i]);
    const bool is_class = !context_.roster.find(spec.name).library.name.empty();
    if (text.empty() || is_class)
      text += choose::code_for(context_.roster, spec, workload_, description_.query);
    if (is_class || !workload_.scene) break;
  }
  return text;
}

void ChooseCommand::measure() {
  workers::WorkerOptions workers = worker_options(options_.workers);
  workers.core = description_.core;
  measurement::Comparison comparison(context_.roster, workload_, selection_.contestants, workers,
                                     description_.effort, selection_.seed);
  support::ProgressLine progress;
  comparison.set_progress([&](const std::string& motion, const std::string& contestant) {
    progress.show(fmt::format("{}: {}", motion, contestant));
  });
  try {
    for (std::size_t trace = 0; trace < workload_.traces.size(); ++trace)
      rows_.push_back(comparison.run(trace, description_.query));
  } catch (const support::Interrupted&) {
    description_.finished = false;
  }
  description_.steadiness = comparison.steadiness();
  candidates_ = choose::candidates_of(rows_);
  save(comparison);
}

std::string ChooseCommand::run_json(const measurement::Comparison& comparison) const {
  auto json =
      nlohmann::ordered_json::parse(results::run_json(description_, workload_, comparison.contestants()));
  const std::vector<std::size_t> ranked = choose::ranking(candidates_, limits_);
  json["choose"] = {
      {"rate_hz", limits_.rate_hz},
      {"share", limits_.share},
      {"recommended",
       description_.finished && !ranked.empty() ? candidates_[ranked.front()].contestant() : ""}};
  if (limits_.max_bytes) json["choose"]["max_bytes"] = *limits_.max_bytes;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

void ChooseCommand::save(const measurement::Comparison& comparison) const {
  if (!folder_) return;
  std::vector<measurement::ResultRow> rows;
  for (const std::vector<measurement::ResultRow>& some : rows_)
    rows.insert(rows.end(), some.begin(), some.end());
  folder_->write(results::results_csv(description_.run_id, rows), run_json(comparison));
  if (!description_.finished) return;
  folder_->write_file("choose.csv", choose::choose_csv(description_.run_id, asked(), candidates_));
  const std::vector<std::size_t> ranked = choose::ranking(candidates_, limits_);
  if (!ranked.empty()) folder_->write_file("choose.cpp", code(ranked));
}

int ChooseCommand::report() const {
  support::StandardOutput out;
  out.write('\n' + choose::candidate_table(asked(), candidates_) + '\n' +
            choose::recommendation(asked(), candidates_));
  const std::vector<std::size_t> ranked = choose::ranking(candidates_, limits_);
  if (!ranked.empty()) out.write('\n' + code(ranked));
  out.finish();
  return ranked.empty() ? support::exit_check_failed : support::exit_done;
}

int ChooseCommand::run() {
  support::watch_for_interrupts();
  support::StandardOutput out;
  out.write(choose::asked_text(asked()));
  out.finish();
  measure();
  if (!description_.finished) {
    fmt::print(stderr, "touchmark: interrupted; nothing is recommended by {} of {} motions\n", rows_.size(),
               workload_.traces.size());
    return support::exit_interrupted;
  }
  return report();
}

}  // namespace

void add_choose(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<ChooseOptions>();
  options->selectors.motion.rate = "1000";
  CLI::App* command =
      program.add_subcommand("choose", "which detector, with which options, for this part on this machine?");
  add_selectors(*command, context, options->selectors);
  add_scene_selectors(*command, options->selectors);
  add_unit(*command, options->selectors.unit);
  command->get_option("--rate")
      ->description("of the servo loop; motion goes by time, so motion files with times are resampled to it")
      ->capture_default_str();
  command->get_option("--trajectory")
      ->description(
          "as --motion, or a name (touchmark list); repeatable; default: slide, fast-slide (ten "
          "times as fast; not over a scene of bodies), approach, hover and cross");
  command->get_option("--detector")
      ->description("a candidate as NAME[:key=value,...]; repeatable; default: ours and the exact rivals");
  command->add_option("--motion", options->motions, "how your hand moves: a motion file; repeatable")
      ->type_name("CSV")
      ->expected(1)
      ->take_all();
  command->add_option("--share", options->share, "the part of a tick that a query may take")
      ->type_name("P%")
      ->capture_default_str();
  command->add_option("--memory", options->memory, "what a detector may take, as 50MB; default: any amount")
      ->type_name("SIZE");
  command->add_option("--out", options->out, "folder for choose.csv, choose.cpp, results.csv and run.json")
      ->type_name("DIR");
  command->add_flag("--quick", options->quick, "fewer steps, and fewer queries with emptied caches");
  add_worker_selectors(*command, options->workers);
  command->footer(
      "A candidate holds if the oracle finds no wrong answer, it keeps within the memory, and on every\n"
      "motion 99.9 % of warm queries and 99 % of those with all caches emptied keep within the share. The\n"
      "fastest of those is recommended; of candidates less than 15 % apart the one that takes less memory.\n"
      "Exit status 1: none holds.\n"
      "Example: touchmark choose --mesh part.stl --motion hand.csv --rate 1000 --share 10% --memory 50MB\n"
      "         touchmark choose --scene parts.json --poses parts.csv --motion hand.csv\n");
  command->final_callback([options, &context] { context.status = ChooseCommand(context, *options).run(); });
}

}  // namespace touchmark::bench::cli
