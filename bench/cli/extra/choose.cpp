/// `touchmark choose`: which detector, with which options, for this part on this machine?
#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <ratio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/options.h"
#include "bench/cli/program.h"
#include "bench/cli/run_frame.h"
#include "bench/cli/selected_workload.h"
#include "bench/cli/selector_options.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/entry.h"
#include "bench/contestants/selectors.h"
#include "bench/experiments/choose/candidate.h"
#include "bench/experiments/choose/choose_code.h"
#include "bench/experiments/choose/choose_csv.h"
#include "bench/experiments/choose/choose_motions.h"
#include "bench/experiments/choose/choose_report.h"
#include "bench/experiments/choose/decision.h"
#include "bench/measurement/comparison.h"
#include "bench/meshes/meshes.h"
#include "bench/results/results_csv.h"
#include "bench/support/checked.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/numbers.h"
#include "bench/support/system/interrupt.h"
#include "bench/support/timed_progress.h"

namespace touchmark::bench::cli {

namespace choose = experiments::choose;

namespace {

struct ChooseOptions {
  contestants::Selectors selectors;
  std::vector<std::string> motions;
  std::string share = "10%", minutes = "3", memory, out;
  bool quick = false, proxy = false;
  WorkerSelectors workers;
};

// All throw std::invalid_argument naming the option and the value.

constexpr double max_rate_hz = 100'000;

/// 10% or 0.1.
double checked_share(const std::string& text) {
  const double share = support::parse_share(text);
  if (!(share > 0) || share > 1)
    throw support::bad_value("--share", text, "a part of a tick: above 0 and at most 100%, or 1");
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
    throw support::bad_value("--memory", given, "a size above 0: bytes, or as 800KB, 50MB or 2GB");
  return *value * unit;
}

experiments::choose::Limits checked_limits(const ChooseOptions& options) {
  return {
      support::checked_number("--rate", options.selectors.motion.rate, support::Zero::refused, max_rate_hz),
      checked_share(options.share), checked_memory(options.memory)};
}

/// Returns the selectors of what is compared: for a proxy it is the sweep.
contestants::Selectors checked_selectors(const ChooseOptions& options) {
  contestants::Selectors selectors = options.selectors;
  if (!options.proxy) return selectors;
  if (selectors.query != contestants::Selectors().query && selectors.query != "sweep")
    throw std::invalid_argument(fmt::format(
        "--proxy compares sweeps, not --query {}: leave out --query, or --proxy", selectors.query));
  selectors.query = "sweep";
  return selectors;
}

/// Returns how long the command may take.
support::Deadline::duration checked_minutes(const ChooseOptions& options) {
  constexpr double most = 1e6;
  const std::optional<double> minutes = support::parse_number(options.minutes);
  if (!minutes || !(*minutes > 0) || *minutes > most)
    throw support::bad_value("--minutes", options.minutes,
                             fmt::format("a number above 0 and at most {:.0f}", most));
  return std::chrono::duration_cast<support::Deadline::duration>(
      std::chrono::duration<double, std::ratio<60>>(*minutes));
}

/// Sets the defaults as well.
void add_choose_options(CLI::App& command, ProgramContext& context, ChooseOptions& options) {
  options.selectors.motion.rate = "1000";
  add_selectors(command, context, options.selectors);
  add_scene_selectors(command, options.selectors);
  add_unit(command, options.selectors.unit);
  command.get_option("--rate")
      ->description("of the servo loop; motion goes by time, so motion files with times are resampled to it")
      ->capture_default_str();
  command.get_option("--trajectory")
      ->description(
          "as --motion, a name (touchmark list), or fast-slide, ten times as fast as slide and not over a "
          "scene of bodies; repeatable; default: hand, approach, hover and cross");
  command.get_option("--detector")
      ->description("a candidate as NAME[:key=value,...]; repeatable; default: ours and the exact rivals");
  add_list(command, "--motion", options.motions, "CSV", "how your hand moves: a motion file; repeatable");
  add_value(command, "--share", options.share, "P%", "the part of a tick that a query may take");
  add_value(command, "--memory", options.memory, "SIZE",
            "what a detector may take, as 50MB; default: any amount");
  add_value(command, "--minutes", options.minutes, "M",
            "how long to measure: what was measured by then is compared, and status 4 says that nothing was");
  add_value(command, "--out", options.out, "DIR",
            "folder for choose.csv, choose.cpp, results.csv and run.json");
  command.add_flag(
      "--proxy", options.proxy,
      "compare detectors that keep to a bound of work by their sweeps, and print a class that steps a proxy");
  command.add_flag("--quick", options.quick, "fewer steps, and fewer queries with emptied caches");
  add_worker_selectors(command, options.workers);
}

/// Returns the user's motions; without any a hand along the surface, presses, free motion, and ways through
/// thin parts.
std::vector<std::string> motions_of(const ChooseOptions& options) {
  std::vector<std::string> motions = options.motions;
  motions.insert(motions.end(), options.selectors.trajectories.begin(), options.selectors.trajectories.end());
  return or_else(motions, {"hand", "approach", "hover", "cross"});
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

/// Throws std::invalid_argument where one that was asked for by name keeps to no bound.
void keep_those_for_a_proxy(const contestants::Roster& roster, bool by_name,
                            std::vector<contestants::ContestantSpec>& specs) {
  const auto is_unfit = [&](const contestants::ContestantSpec& spec) {
    const contestants::ContestantInfo& info = roster.find(spec.name);
    const std::string name = info.library ? info.library(spec.values).name : "";
    return (name != "SphereCluster" && name != "GridGroup") || contestants::asks_for_side(spec.values);
  };
  const auto unfit = std::ranges::find_if(specs, is_unfit);
  if (by_name && unfit != specs.end())
    throw std::invalid_argument(fmt::format(
        "--proxy: {} keeps to no bound of work; sphere-cluster and grid-group do", unfit->text()));
  std::erase_if(specs, is_unfit);
}

workload::Workload workload_for(const ChooseOptions& options, const workload::Selection& selection,
                                double rate_hz) {
  const contestants::Selectors& selectors = options.selectors;
  if (!selectors.scene.empty())
    return choose::workload_by_time(scene_of(selectors), selection, motions_of(options), rate_hz);
  const std::string mesh = mesh_of(selectors);
  return choose::workload_by_time(results::without_directories(mesh),
                                  meshes::load_mesh(mesh, selectors.normalize), selection,
                                  motions_of(options), rate_hz);
}

class ChooseCommand {
 public:
  ChooseCommand(const ProgramContext& context, const ChooseOptions& options)
      : context_(context),
        options_(options),
        deadline_(start_ + checked_minutes(options)),
        progress_(std::in_place, "choose", start_, deadline_),
        limits_(checked_limits(options)),
        selection_(contestants::check(checked_selectors(options), context.roster)),
        workers_(worker_options(options.workers)),
        frame_(context, options.out),
        workload_(workload_for(options, selection_, limits_.rate_hz)) {
    frame_.description.query = selection_.queries.front();
    if (options.selectors.detectors.empty())
      selection_.contestants = options.selectors.scene.empty()
                                   ? context.roster.candidates(frame_.description.query)
                                   : context.roster.scene_candidates(frame_.description.query);
    if (options.proxy)
      keep_those_for_a_proxy(context.roster, !options.selectors.detectors.empty(), selection_.contestants);
    frame_.description.seed = selection_.seed;
    frame_.description.effort = effort_for(options.quick);
    frame_.description.core = workers_.core = results::core_for_workers();
  }

  /// Returns an exit status. Throws ResourceError, std::invalid_argument or MeshError.
  int run() {
    support::watch_for_interrupts(deadline_);
    progress_.reset();
    support::StandardOutput out;
    out.write(choose::asked_text(asked()));
    out.finish();
    progress_.emplace("choose", start_, deadline_);
    measure();
    if (interrupted_)
      return interrupted(
          fmt::format("nothing is recommended by {} of {} motions", rows_.size(), workload_.traces.size()));
    if (time_is_up_ &&
        std::ranges::none_of(candidates_, [](const auto& one) { return one.times.has_value(); })) {
      fmt::print(
          stderr,
          "touchmark: nothing is recommended: no candidate was measured within {:g} minutes; allow more "
          "by --minutes\n",
          minutes());
      return support::exit_inconclusive;
    }
    return report();
  }

 private:
  choose::Asked asked() const { return {workload_, frame_.description.query, limits_}; }
  const contestants::ContestantSpec& spec_of(const choose::Candidate& candidate) const {
    return *std::ranges::find_if(selection_.contestants, [&](const contestants::ContestantSpec& spec) {
      return spec.text() == candidate.contestant();
    });
  }

  /// Returns the recommended one's; where that is no class of the library, also that of the best one that is.
  std::string code(const std::vector<std::size_t>& ranked) const {
    std::string text;
    for (const std::size_t i : ranked) {
      const contestants::ContestantSpec& spec = spec_of(candidates_[i]);
      const bool is_class = context_.roster.find(spec.name).library != nullptr;
      if (text.empty() || is_class)
        text +=
            choose::code_for(context_.roster, spec, workload_, {frame_.description.query, options_.proxy});
      if (is_class || !workload_.scene) break;
    }
    return text;
  }

  double minutes() const { return std::chrono::duration<double, std::ratio<60>>(deadline_ - start_).count(); }
  void measure() {
    measurement::Comparison comparison(context_.roster, workload_, selection_.contestants, workers_,
                                       frame_.description.effort, selection_.seed);
    measure_motions(comparison);
    progress_.reset();
    frame_.description.steadiness = comparison.steadiness();
    candidates_ = choose::candidates_of(rows_);
    for (const contestants::ContestantSpec& spec : selection_.contestants) {
      const auto is_it = [&](const choose::Candidate& one) { return one.contestant() == spec.text(); };
      if (std::ranges::none_of(candidates_, is_it)) unmeasured_.push_back(spec.text());
    }
    save(comparison);
  }

  void measure_motions(measurement::Comparison& comparison) {
    comparison.set_progress([&](const std::string& motion, const std::string& contestant) {
      progress_->show(fmt::format("{} of {} motions done; {}: {}", rows_.size(), workload_.traces.size(),
                                  motion, contestant));
    });
    try {
      while (rows_.size() < workload_.traces.size())
        rows_.push_back(comparison.run(rows_.size(), frame_.description.query));
      return;
    } catch (const support::OutOfTime&) {
      time_is_up_ = true;
    } catch (const support::Interrupted&) {
      interrupted_ = true;
    }
    frame_.description.finished = false;
    whole_motions_ = rows_.size();
    if (time_is_up_) add_partial_motion(comparison);
  }

  /// Adds what was measured of the motion during which time was up, where no other counts or it is no less.
  void add_partial_motion(measurement::Comparison& comparison) {
    std::vector<measurement::ResultRow> rows = comparison.so_far();
    std::erase_if(rows, [](const measurement::ResultRow& row) { return row.status == "ok" && !row.cold; });
    const bool is_no_less = rows.size() == selection_.contestants.size();
    if (is_no_less || rows_.empty()) rows_.push_back(std::move(rows));
  }

  std::string time_is_up_text() const {
    std::size_t samples = std::numeric_limits<std::size_t>::max();
    for (const choose::Candidate& one : candidates_)
      if (one.times) samples = std::min(samples, one.times->cold_samples);
    return fmt::format(
        "note: the {:g} minutes were up: {} of {} motions were measured, {} in part; {} or more samples with "
        "all caches emptied for each candidate; not measured: {}; a larger --minutes measures the rest\n",
        minutes(), rows_.size(), workload_.traces.size(), rows_.size() - whole_motions_, samples,
        unmeasured_.empty() ? "none" : fmt::format("{}", fmt::join(unmeasured_, ", ")));
  }

  void save(const measurement::Comparison& comparison) const {
    if (!frame_.folder) return;
    std::vector<measurement::ResultRow> rows;
    for (const std::vector<measurement::ResultRow>& some : rows_)
      rows.insert(rows.end(), some.begin(), some.end());
    frame_.folder->write(results::results_csv(frame_.description.run_id, rows), run_json(comparison));
    if (interrupted_) return;
    frame_.folder->write_file("choose.csv",
                              choose::choose_csv(frame_.description.run_id, asked(), candidates_));
    const std::vector<std::size_t> ranked = choose::ranking(candidates_, limits_);
    if (!ranked.empty()) frame_.folder->write_file("choose.cpp", code(ranked));
  }

  std::string run_json(const measurement::Comparison& comparison) const {
    auto json = nlohmann::ordered_json::parse(
        results::run_json(frame_.description, workload_, comparison.contestants()));
    const std::vector<std::size_t> ranked = choose::ranking(candidates_, limits_);
    json["choose"] = {
        {"rate_hz", limits_.rate_hz},
        {"share", limits_.share},
        {"recommended", !interrupted_ && !ranked.empty() ? candidates_[ranked.front()].contestant() : ""},
        {"minutes", minutes()},
        {"not_measured", unmeasured_}};
    if (limits_.max_bytes) json["choose"]["max_bytes"] = *limits_.max_bytes;
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
  }

  int report() const {
    support::StandardOutput out;
    out.write('\n' + choose::candidate_table(asked(), candidates_) + '\n' +
              choose::recommendation(asked(), candidates_));
    const std::vector<std::size_t> ranked = choose::ranking(candidates_, limits_);
    if (!ranked.empty()) out.write('\n' + code(ranked));
    if (time_is_up_) out.write('\n' + time_is_up_text());
    if (!ranked.empty()) return support::exit_done;
    return unmeasured_.empty() ? support::exit_check_failed : support::exit_inconclusive;
  }

  const ProgramContext& context_;
  const ChooseOptions& options_;
  support::Deadline start_ = support::Deadline::clock::now(), deadline_;
  std::optional<support::TimedProgress> progress_;
  bool time_is_up_ = false, interrupted_ = false;
  choose::Limits limits_;
  contestants::CheckedSelectors selection_;
  workers::WorkerOptions workers_;
  RunFrame frame_;
  workload::Workload workload_;
  std::vector<std::vector<measurement::ResultRow>> rows_;  // by motion
  std::vector<choose::Candidate> candidates_;
  std::size_t whole_motions_ = 0;        // where time was up
  std::vector<std::string> unmeasured_;  // contestants
};

}  // namespace

void add_choose(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<ChooseOptions>();
  CLI::App* command = add_command(program, "choose");
  add_choose_options(*command, context, *options);
  command->footer(
      "A candidate holds if the oracle finds no wrong answer, it keeps within the memory, and on every\n"
      "motion 99.9 % of warm queries and 99 % of those with all caches emptied keep within the share. The\n"
      "fastest of those is recommended; of candidates less than 15 % apart the one that takes less memory.\n"
      "Exit status 1: none holds; 4: --minutes were up before that was known.\n"
      "Example: touchmark choose --mesh part.stl --motion hand.csv --rate 1000 --share 10% --memory 50MB\n"
      "         touchmark choose --scene parts.json --poses parts.csv --motion hand.csv\n");
  command->final_callback([options, &context] { context.status = ChooseCommand(context, *options).run(); });
}

}  // namespace touchmark::bench::cli
