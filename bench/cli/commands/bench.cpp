/// `touchmark bench`: verify, then time, every contestant on every trajectory; print the table; leave
/// results.csv and run.json.
#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/benchmark_flags.h"
#include "bench/cli/extra/bench_suite.h"
#include "bench/cli/options.h"
#include "bench/cli/program.h"
#include "bench/cli/repeat_command.h"
#include "bench/cli/report_files.h"
#include "bench/cli/run_frame.h"
#include "bench/cli/selected_workload.h"
#include "bench/cli/selector_options.h"
#include "bench/cli/step_outputs.h"
#include "bench/cli/worker_options.h"
#include "bench/measurement/comparison.h"
#include "bench/measurement/result_row.h"
#include "bench/results/google_benchmark_json.h"
#include "bench/results/report_table.h"
#include "bench/results/results_csv.h"
#include "bench/results/run_json.h"
#include "bench/results/steps_file.h"
#include "bench/results/verification_report.h"
#include "bench/support/checked.h"
#include "bench/support/files/standard_output.h"
#include "bench/workers/timing/cache_lines.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::cli {
namespace {

/// What `touchmark bench` leaves for other programs beside --out: Google Benchmark's JSON and Markdown.
class BenchReports {
 public:
  /// Opens the files. Throws ResourceError.
  BenchReports(const BenchmarkFlags& flags, const ReportSelectors& selectors)
      : json_(flags.list_tests ? "" : flags.out),
        markdown_(flags.list_tests ? "" : selectors.markdown),
        summed_up_(flags.aggregates_only) {}

  /// `verdict` is said under the table of the trajectory's rows.
  void add_trajectory(const std::string& title, const std::vector<measurement::ResultRow>& rows,
                      const std::string& verdict) {
    tables_ +=
        fmt::format("\n### {}\n\n{}{}", title, results::timing_table(rows).markdown(), code_block(verdict));
  }

  /// Throws ResourceError.
  void write(const results::RunDescription& run, const std::vector<measurement::ResultRow>& rows) {
    if (json_.wanted()) {
      using results::Repetitions;
      json_.write(
          results::google_benchmark_json(run, rows, summed_up_ ? Repetitions::summed_up : Repetitions::each));
    }
    if (markdown_.wanted())
      markdown_.write(fmt::format("## touchmark bench{}\n{}\n{}", run.finished ? "" : " (interrupted)",
                                  tables_, results::judged_answers(rows)));
  }

 private:
  ReportFile json_, markdown_;
  bool summed_up_;
  std::string tables_;
};

constexpr std::size_t faulty_rows_shown = 20;
const std::vector<std::string> default_trajectories{"hand", "approach", "hover", "jump"};

struct BenchOptions {
  contestants::Selectors selectors;
  std::string out, steps_out;
  bool quick = false;
  bool frontier = false;
  bool work = false;
  bool cold = true;
  std::string cold_samples;
  bool wide = false;
  bool cache_lines = false;
  bool suite = false;
  std::string cells, minutes;  ///< for the suite alone
  ReportSelectors reports;
  WorkerSelectors workers;
};

/// Returns the value of --cold-samples, if it was given. Throws std::invalid_argument.
std::optional<std::size_t> cold_samples_of(const BenchOptions& options) {
  if (options.cold_samples.empty()) return std::nullopt;
  return support::checked_count("--cold-samples", options.cold_samples, 1, 100'000);
}

/// `rows`: pairs of contestant and trajectory, which share the time for queries with emptied caches.
measurement::Effort effort_for(const BenchOptions& options, const BenchmarkFlags& flags, std::size_t rows) {
  measurement::Effort effort;
  if (options.quick) effort = measurement::quick_effort;
  effort.repetitions = flags.repetitions.value_or(effort.repetitions);
  if (options.cold) {
    effort.cold_passes = options.quick ? measurement::quick_cold_passes : measurement::usual_cold_passes;
    if (options.quick) {
      effort.cold_samples = measurement::quick_cold_samples;
      effort.cold_l2_samples = measurement::quick_cold_l2_samples;
    }
    effort.cold_budget_ns =
        (options.quick ? measurement::quick_cold_budget_ns : measurement::usual_cold_budget_ns) /
        static_cast<double>(std::max<std::size_t>(rows, 1));
  }
  if (const std::optional<std::size_t> samples = cold_samples_of(options)) effort.take_all_cold(*samples);
  if (options.cache_lines)
    effort.line_samples = options.quick ? measurement::quick_line_samples : measurement::usual_line_samples;
  if (!options.out.empty() || !options.steps_out.empty())
    effort.max_logged_steps = results::max_steps_in_file;
  if (flags.min_time_s) effort.repetition_ns = *flags.min_time_s * 1e9;
  return effort;
}

contestants::CheckedSelectors checked(const BenchOptions& options, const contestants::Roster& roster) {
  contestants::CheckedSelectors selection = contestants::check(options.selectors, roster);
  if (options.cache_lines) workers::require_line_counting();
  return selection;
}

/// The whole run, from the checked command line to the last row.
class BenchRun {
 public:
  BenchRun(const ProgramContext& context, const BenchOptions& options, const BenchmarkFlags& flags)
      : flags_(flags),
        selectors_(options.selectors),
        trajectories_(or_else(selectors_.trajectories, default_trajectories)),
        selection_(checked(options, context.roster)),
        workers_(worker_options(options.workers)),
        frame_(context, flags.list_tests ? "" : options.out),
        reports_(flags, options.reports),
        step_outputs_(frame_.folder ? &*frame_.folder : nullptr, flags.list_tests ? "" : options.steps_out),
        workload_(workload_of(selectors_, mesh_of(selectors_), selection_, trajectories_,
                              options.quick ? 5000 : 20000)),
        quick_(options.quick),
        shows_work_(options.work),
        wide_(options.wide) {
    frame_.description.query = selection_.queries.front();
    frame_.description.seed = selection_.seed;
    frame_.description.effort = effort_for(options, flags, wanted_rows());
    frame_.description.core = workers_.core = results::core_for_workers();
    workers_.flags = flags.forwarded;
    comparison_.emplace(context.roster, workload_, selection_.contestants, workers_,
                        frame_.description.effort, selection_.seed);
    comparison_->set_filter([this](const std::string& trajectory, const std::string& contestant) {
      return wanted(trajectory, contestant);
    });
    comparison_->set_progress([this](const std::string& trajectory, const std::string& contestant) {
      frame_.progress.show(fmt::format("{}: {}", trajectory, contestant));
    });
  }

  /// An exit status. Throws ResourceError.
  int run() {
    out_.write(workload::question_text(workload_, frame_.description.query) + '\n');
    const bool finished = frame_.finishes([this] { run_trajectories(); });
    if (!finished) std::ranges::move(comparison_->so_far(), std::back_inserter(rows_));
    leave();
    if (!finished) return interrupted(rows_.size());
    std::vector<measurement::ResultRow> broken;  // what others err by is in the table
    std::copy_if(rows_.begin(), rows_.end(), std::back_inserter(broken), results::claim_is_broken);
    const std::string failures = results::list_of_failures(broken, faulty_rows_shown);
    if (!rows_.empty()) out_.write('\n' + results::overall_verdict(rows_));
    out_.write(
        fmt::format("\n{}{}", results::judged_answers(rows_), failures.empty() ? "" : "\n" + failures));
    out_.finish();
    const bool faulty =
        results::print_faults(rows_, [](const measurement::ResultRow& row) { return row.trajectory; });
    return rows_.empty() ? support::exit_done : results::status_of(rows_, faulty);
  }

  void list_cases() {
    for (const std::string& trajectory : workload_.trajectories)
      for (const contestants::ContestantSpec& spec : selection_.contestants)
        if (wanted(trajectory, spec.text())) out_.write(fmt::format("{}/{}\n", spec.text(), trajectory));
  }

 private:
  void run_trajectories() {
    for (std::size_t trace = 0; trace < workload_.traces.size(); ++trace) {
      comparison_->begin(trace, frame_.description.query);
      save_so_far();
      if (trace == 0 && !quick_ && workload_.traces.size() > 1) show_first_half();
    }
    for (std::size_t trace = 0; trace < workload_.traces.size(); ++trace) end_trajectory(trace);
  }

  /// Shows the first trajectory to who waits: its other half comes after the first half of all.
  void show_first_half() {
    const std::vector<measurement::ResultRow> rows = comparison_->so_far();
    if (rows.empty()) return;
    frame_.progress.clear();
    out_.write(fmt::format("\n{}, half of its rounds\n{}", workload_.trajectories.front(), table_of(rows)));
    out_.finish();
  }

  std::string table_of(const std::vector<measurement::ResultRow>& rows) const {
    return wide_ ? results::timing_table(rows).text() : results::comparison_text(rows);
  }

  void end_trajectory(std::size_t trace) {
    std::vector<measurement::ResultRow> rows = comparison_->end();
    if (rows.empty()) return;
    for (measurement::ResultRow& row : rows)
      row.repeat = repeat_command(selectors_, mesh_of(selectors_), trajectories_, workload_, row);
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    save_so_far();
    frame_.progress.clear();
    const std::string title =
        fmt::format("{} ({})", workload_.trajectories[trace], workload::trace_text(workload_, trace));
    const std::string verdict = results::verdict(rows, comparison_->steadiness().back());
    reports_.add_trajectory(title, rows, verdict);
    out_.write(fmt::format("\n{}\n{}{}", title, table_of(rows), verdict));
    const std::string cold = results::cold_table(rows);
    if (!cold.empty()) out_.write('\n' + cold);
    const std::string lines = results::lines_table(rows);
    if (!lines.empty()) out_.write('\n' + lines);
    if (shows_work_) out_.write('\n' + results::work_table(rows));
    out_.finish();
  }

  /// What has been timed in part counts as well, should it end here.
  void save_so_far() {
    std::vector<measurement::ResultRow> rows = rows_;
    std::ranges::move(comparison_->so_far(), std::back_inserter(rows_));
    save(false);
    rows_ = std::move(rows);
  }

  void save(bool finished) const {
    if (!frame_.folder) return;
    results::RunDescription description = frame_.description;
    description.finished = finished;
    description.steadiness = comparison_->steadiness();
    description.left_out = comparison_->left_out();
    frame_.folder->write(results::results_csv(description.run_id, rows_),
                         results::run_json(description, workload_, comparison_->contestants()));
  }

  /// Writes every file that the run was asked for.
  void leave() {
    save(frame_.description.finished);
    step_outputs_.write(frame_.description.run_id, workload_, *comparison_, rows_);
    reports_.write(frame_.description, rows_);
  }

  bool wanted(const std::string& trajectory, const std::string& contestant) const {
    return flags_.wanted(contestant + "/" + trajectory);
  }

  std::size_t wanted_rows() const {
    std::size_t rows = 0;
    for (const std::string& trajectory : workload_.trajectories)
      for (const contestants::ContestantSpec& spec : selection_.contestants)
        rows += wanted(trajectory, spec.text()) ? 1 : 0;
    return rows;
  }

  BenchmarkFlags flags_;
  contestants::Selectors selectors_;
  std::vector<std::string> trajectories_;
  contestants::CheckedSelectors selection_;
  workers::WorkerOptions workers_;
  RunFrame frame_;
  BenchReports reports_;
  StepOutputs step_outputs_;
  workload::Workload workload_;
  std::optional<measurement::Comparison> comparison_;
  support::StandardOutput out_;
  bool quick_;
  bool shows_work_;
  bool wide_;
  std::vector<measurement::ResultRow> rows_;
};

}  // namespace

void add_bench(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<BenchOptions>();
  CLI::App* command = add_command(program, "bench");
  add_selectors(*command, context, options->selectors);
  add_scene_selectors(*command, options->selectors);
  add_unit(*command, options->selectors.unit);
  add_value(*command, "--out", options->out, "DIR", "folder for results.csv, run.json and steps.bin");
  add_value(*command, "--steps-out", options->steps_out, "FILE",
            "also each step as CSV: time, answer and work");
  command
      ->add_flag("--frontier", options->frontier,
                 "every contestant over the options that trade accuracy for time (see the plot time_error)")
      ->excludes("--detector");
  command->add_flag("--work", options->work, "also what a step looked at, and so what it skipped");
  command->add_flag("--wide", options->wide, "tables with all columns and whole names, in the order asked");
  CLI::Option* const cold = command->add_flag(
      "--cold,!--no-cold", options->cold,
      "also queries with the second-level cache, or all caches, emptied between them; default: yes");
  add_value(*command, "--cold-samples", options->cold_samples, "N",
            "take all of N queries with all caches emptied a row, and 10 N with the second-level cache "
            "emptied; default: up to 400, as many as fit into 16 s")
      ->excludes(cold);
  command->add_flag("--cache-lines", options->cache_lines,
                    "also how many cache lines a query touches, as valgrind counts them");
  command->add_flag("--quick", options->quick, "fewer steps and repetitions");
  add_suite(*command, options->suite, options->cells, options->minutes);
  add_markdown(*command, options->reports);
  add_worker_selectors(*command, options->workers);
  command->allow_extras();
  command->footer(
      "Any --benchmark_* flag of Google Benchmark may be added: --benchmark_repetitions=9,\n"
      "--benchmark_min_time=0.2, --benchmark_filter=REGEX on contestant/trajectory, and\n"
      "--benchmark_out=FILE for Google Benchmark's own JSON.\n"
      "Example: touchmark bench --mesh bunny --trajectory slide --detector grid-group --detector "
      "fcl:bv=obbrss --out results/today\n"
      "         touchmark bench --mesh part.stl --unit mm --trajectory hand.csv --motion-scale 1000 --rate "
      "1000\n"
      "         touchmark bench --scene heap:1000:motion=all --radius 0.1%\n"
      "         touchmark bench --suite --quick --out results/suite\n");
  command->final_callback([options, command, &context] {
    const BenchmarkFlags flags = parse_benchmark_flags(command->remaining());
    if (options->suite) {
      expect_options_of_suite(*command);
      if (!flags.out.empty()) throw std::invalid_argument("--benchmark_out does not go with --suite");
      if (!context.parts.run_suite) continue_in_extra_program(context);
      context.status = context.parts.run_suite(
          context, {options->selectors, options->out, options->cells, options->minutes,
                    cold_samples_of(*options), options->quick, options->workers});
      return;
    }
    if (options->frontier) {
      for (const contestants::ContestantSpec& spec : context.roster.forms(&contestants::Forms::frontier))
        options->selectors.detectors.push_back(spec.text());
    }
    BenchRun run(context, *options, flags);
    if (flags.list_tests) return run.list_cases();
    context.status = run.run();
  });
}

}  // namespace touchmark::bench::cli
