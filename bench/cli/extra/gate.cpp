/// `touchmark gate`: has a detector become slower, against a reference measured in the same run? For the
/// continuous integration of those who use a detector.
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/options.h"
#include "bench/cli/program.h"
#include "bench/cli/report_files.h"
#include "bench/cli/run_frame.h"
#include "bench/cli/selected_workload.h"
#include "bench/cli/selector_options.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/roster.h"
#include "bench/contestants/selectors.h"
#include "bench/regression/gate/baseline.h"
#include "bench/regression/gate/gate_report.h"
#include "bench/regression/gate/paired_batch.h"
#include "bench/results/build_info.h"
#include "bench/results/system_info.h"
#include "bench/support/checked.h"
#include "bench/support/files/atomic_file.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/length.h"
#include "bench/workload/content_hash.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::cli {

namespace gate = regression::gate;

namespace {

struct GateOptions {
  contestants::Selectors selectors;
  std::string reference = "aabb-tree", baseline, tolerance = "7%", report;
  std::size_t rounds = regression::gate::GateEffort{}.rounds;
  bool write_baseline = false;
  ReportSelectors reports;
  WorkerSelectors workers;
};

constexpr const char* gate_footer =
    R"(Exit status 0: no slower than the baseline, or by less than the tolerance. 1: slower, and a second batch
agrees; or other answers or more work than in the baseline; or wrong answers. 4: inconclusive, since the
reference, measured twice in every round, did not measure equal to itself.
Example: touchmark gate --mesh part.stl --trajectory hand.csv --detector grid-group --baseline gate.csv --write-baseline
         touchmark gate --mesh part.stl --trajectory hand.csv --detector grid-group --baseline gate.csv
)";

/// Throws std::invalid_argument.
double checked_tolerance(const std::string& text) {
  const double value = support::parse_share(text);
  if (!(value > 0 && value < 1))
    throw support::bad_value("--tolerance", text, "above 0 and below 100%, as 7%");
  return value;
}

void add_gate_options(CLI::App& command, ProgramContext& context, GateOptions& options) {
  add_selectors(command, context, options.selectors);
  add_scene_selectors(command, options.selectors);
  add_value(command, "--reference", options.reference, "D", "the contestant whose time is the unit");
  add_value(command, "--baseline", options.baseline, "FILE",
            "CSV file of ratios; it may come from another machine")
      ->required();
  command.add_flag("--write-baseline", options.write_baseline, "measure, and write the rows of --baseline");
  add_value(command, "--tolerance", options.tolerance, "PERCENT", "how much slower is not a fault");
  add_value(command, "--rounds", options.rounds, "N", "turns of each contestant in a batch");
  add_value(command, "--report", options.report, "FILE", "CSV file of what was found");
  add_junit(command, options.reports);
  add_markdown(command, options.reports);
  add_worker_selectors(command, options.workers);
  command.footer(gate_footer);
}

workers::WorkerOptions workers_for(const GateOptions& options) {
  workers::WorkerOptions workers = worker_options(options.workers);
  workers.core = results::core_for_workers();
  workers.calibrate_clock = false;
  return workers;
}

/// An absent file is none yet for those who write it.
gate::Baseline baseline_for(const GateOptions& options) {
  std::error_code ignored;
  if (options.write_baseline && !std::filesystem::exists(options.baseline, ignored)) return {};
  return gate::Baseline::read(options.baseline);
}

contestants::CheckedSelectors checked(const GateOptions& options, const contestants::Roster& roster) {
  if (options.selectors.detectors.empty())
    throw std::invalid_argument("--detector is missing: what is gated?");
  if (options.rounds < 5 || options.rounds > 1000)
    throw std::invalid_argument(fmt::format("--rounds \"{}\" is not from 5 to 1000", options.rounds));
  return contestants::check(options.selectors, roster);
}

class Gate {
 public:
  Gate(const ProgramContext& context, const GateOptions& options)
      : roster_(context.roster),
        options_(options),
        selection_(checked(options, roster_)),
        reference_(roster_.parse_all({options.reference}).front()),
        tolerance_(checked_tolerance(options.tolerance)),
        workers_(workers_for(options)),
        baseline_(baseline_for(options)),
        frame_(context, ""),
        junit_(options.reports.junit),
        markdown_(options.reports.markdown),
        workload_(workload_of(options.selectors, mesh_of(options.selectors), selection_,
                              or_else(options.selectors.trajectories, {"slide"}), 5000)),
        mesh_hash_(workload::hash_of_things(workload_)),
        arena_(workload_, workers_),
        truths_(workload_) {}

  int run() {
    std::vector<const gate::BaselineRow*> rows;
    const std::vector<gate::GatePair> pairs = this->pairs();
    if (!options_.write_baseline) {
      for (const gate::GatePair& pair : pairs)
        rows.push_back(&expected(pair));  // before anything is measured
    }
    const auto ask_pair = [&](std::size_t i) {
      const auto start = std::chrono::steady_clock::now();
      options_.write_baseline ? write_pair(pairs[i]) : check_pair(pairs[i], *rows[i]);
      lines_.back().seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    try {
      const bool finished = frame_.finishes([&] {
        for (std::size_t i = 0; i < pairs.size(); ++i) ask_pair(i);
      });
      if (!finished) return interrupted("nothing is judged");
    } catch (const gate::GateFailure& failure) {  // there is nothing to write a baseline from
      frame_.progress.clear();
      fmt::print(stderr, "touchmark: {}\n", failure.what());
      return support::exit_check_failed;
    }
    report();
    if (status_ == support::exit_inconclusive)
      fmt::print(stderr, "touchmark: inconclusive: {} did not measure equal to itself within {}\n",
                 reference_.text(), options_.tolerance);
    if (options_.write_baseline && status_ == support::exit_done) {
      support::AtomicFile file(options_.baseline);
      file.write(baseline_.csv());
      file.commit();
    }
    return status_;
  }

 private:
  std::vector<gate::GatePair> pairs() const {
    std::vector<gate::GatePair> pairs;
    for (std::size_t trace = 0; trace < workload_.traces.size(); ++trace)
      for (const contestants::ContestantSpec& detector : selection_.contestants)
        pairs.push_back({detector, reference_, trace, selection_.queries.front()});
    return pairs;
  }

  gate::GateKey key_of(const gate::GatePair& pair) const {
    return {workload_.mesh_name, workload_.trajectories[pair.trace], std::string(name_of(pair.query)),
            pair.detector.text(), pair.reference.text()};
  }

  const gate::BaselineRow& expected(const gate::GatePair& pair) const {
    const gate::GateKey key = key_of(pair);
    const gate::BaselineRow* const row = baseline_.find(key);
    if (row == nullptr)
      throw std::invalid_argument(
          fmt::format("{}: no row for {} against {} on {}, {}, {} (--write-baseline adds it)",
                      options_.baseline, key.detector, key.reference, key.mesh, key.trajectory, key.query));
    expect_same_content(*row, pair);
    return *row;
  }

  void expect_same_content(const gate::BaselineRow& row, const gate::GatePair& pair) const {
    const auto expect = [&](const char* what, const std::string& name, std::uint64_t then,
                            std::uint64_t now) {
      if (then == now) return;
      throw std::invalid_argument(
          fmt::format("{}: it was written for another {} \"{}\" (fnv1a {:016x}, now {:016x}); write it anew "
                      "with --write-baseline",
                      options_.baseline, what, name, then, now));
    };
    expect("mesh", row.key.mesh, row.mesh_hash, mesh_hash_);
    expect("trajectory, radius or reach", row.key.trajectory, row.trace_hash,
           workload::hash_of_motion(workload_, pair.trace));
  }

  gate::PairedBatches batches(const gate::GatePair& pair, std::size_t steps) {
    gate::GateEffort effort;
    effort.rounds = options_.rounds;
    return {roster_, workload_, arena_, truths_, pair, effort, steps, selection_.seed};
  }

  void check_pair(const gate::GatePair& pair, const gate::BaselineRow& row) {
    gate::PairedBatches batches = this->batches(pair, row.steps);
    gate::GateLine line{row.key, row.ratio, {}, "-", ""};
    try {
      line.judgement = gate::judge(row.ratio.ratio, tolerance_, [&] {
        frame_.progress.show(fmt::format("{}: {}", row.key.trajectory, row.key.detector));
        return batches.measure();
      });
      line.answers = compare_answers(row, batches.answers());
      line.verdict = name_of(line.judgement.verdict);
      if (line.answers != "same" && line.answers != "-") line.verdict = "CHANGED";
    } catch (const gate::GateFailure& failure) {
      frame_.progress.clear();
      fmt::print(stderr, "touchmark: {}\n", failure.what());
      line.verdict = "FAILED";
    }
    judged_ += batches.judged();
    line.failed = line.verdict == "FAILED" || line.verdict == "CHANGED" ||
                  line.judgement.verdict == gate::Verdict::slower;
    if (line.failed) {
      status_ = support::exit_check_failed;
    } else if (line.judgement.verdict == gate::Verdict::inconclusive && status_ == support::exit_done) {
      status_ = support::exit_inconclusive;
    }
    lines_.push_back(std::move(line));
  }

  /// The median over the rounds of two batches whose controls held.
  void write_pair(const gate::GatePair& pair) {
    gate::PairedBatches batches = this->batches(pair, 0);
    gate::GateLine line{key_of(pair), std::nullopt, {}, "-", "inconclusive"};
    std::vector<double> log_ratios;
    int held = 0;
    while (held < 2 && line.judgement.batches < gate::max_batches) {
      frame_.progress.show(fmt::format("{}: {}", line.key.trajectory, line.key.detector));
      line.judgement.batch = batches.measure();
      ++line.judgement.batches;
      if (!gate::control_holds(line.judgement.batch, tolerance_)) continue;
      ++held;
      log_ratios.insert(log_ratios.end(), batches.log_ratios().begin(), batches.log_ratios().end());
    }
    judged_ += batches.judged();
    if (held == 2) {
      line.verdict = "written";
      line.judgement.batch.ratio = gate::median_ratio(log_ratios, selection_.seed);
      baseline_.put({line.key, mesh_hash_, workload::hash_of_motion(workload_, pair.trace), batches.steps(),
                     line.judgement.batch.ratio, batches.answers().work, batches.answers().checksum,
                     results::build_info().version, results::build_info().commit,
                     results::system_info().cpu_model});
    } else {
      status_ = support::exit_inconclusive;
    }
    lines_.push_back(std::move(line));
  }

  /// Less work for the same answers is no fault.
  std::string compare_answers(const gate::BaselineRow& row, const gate::GateAnswers& answers) const {
    if (row.checksum && *row.checksum != answers.checksum) return "answers differ";
    if (row.work && (answers.work.mean > row.work->mean || answers.work.max > row.work->max))
      return fmt::format("more work: {:.6g} a step, was {:.6g}", answers.work.mean, row.work->mean);
    return row.checksum || row.work ? "same" : "-";
  }

  void report() {
    const std::string title =
        fmt::format("times over those of {} in the same rounds, on {}; tolerance {:.3g} %\n",
                    reference_.text(), workload_.mesh_name, 100 * tolerance_);
    const std::string judged = fmt::format("{} answers judged exactly\n", judged_);
    const support::Table table = gate::gate_table(lines_);
    support::StandardOutput out;
    out.write(title + table.text() + judged);
    out.finish();
    if (junit_.wanted()) junit_.write(results::junit_xml("touchmark gate", gate::cases_of(lines_)));
    if (markdown_.wanted())
      markdown_.write(fmt::format("## touchmark gate\n\n{}\n{}\n{}", title, table.markdown(), judged));
    if (options_.report.empty()) return;
    support::AtomicFile file(options_.report);
    file.write(gate::gate_csv(lines_, tolerance_));
    file.commit();
  }

  const contestants::Roster& roster_;
  const GateOptions& options_;
  contestants::CheckedSelectors selection_;
  contestants::ContestantSpec reference_;
  double tolerance_;
  workers::WorkerOptions workers_;
  gate::Baseline baseline_;
  RunFrame frame_;
  ReportFile junit_, markdown_;
  workload::Workload workload_;
  std::uint64_t mesh_hash_;
  workers::SharedArena arena_;
  ground_truth::WorkloadTruths truths_;
  std::vector<gate::GateLine> lines_;
  std::uint64_t judged_ = 0;
  int status_ = support::exit_done;
};

}  // namespace

void add_gate(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<GateOptions>();
  CLI::App* command = add_command(program, "gate");
  add_gate_options(*command, context, *options);
  command->final_callback([options, &context] { context.status = Gate(context, *options).run(); });
}

}  // namespace touchmark::bench::cli
