/// `touchmark gate`: has a detector become slower, against a reference measured in the same run? For the
/// continuous integration of those who use a detector.
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/program.h"
#include "bench/cli/selector_options.h"
#include "bench/cli/worker_options.h"
#include "bench/regression/gate/baseline.h"
#include "bench/regression/gate/gate_report.h"
#include "bench/regression/gate/paired_batch.h"
#include "bench/results/build_info.h"
#include "bench/results/system_info.h"
#include "bench/scenes/scenes.h"
#include "bench/support/atomic_file.h"
#include "bench/support/denormals.h"
#include "bench/support/interrupt.h"
#include "bench/support/length.h"
#include "bench/support/progress.h"
#include "bench/support/standard_output.h"
#include "bench/workload/content_hash.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench {
namespace {

struct GateOptions {
  Selectors selectors;
  std::string reference = "aabb-tree", baseline, tolerance = "7%", report;
  std::size_t rounds = GateEffort{}.rounds;
  bool write_baseline = false;
  WorkerSelectors workers;
};

double checked_tolerance(const std::string& text) {
  const std::optional<Length> tolerance = parse_length(text);
  const double value = tolerance ? (tolerance->percent ? tolerance->value / 100 : tolerance->value) : 0;
  if (!(value > 0 && value < 1)) {
    throw std::invalid_argument(fmt::format("--tolerance \"{}\" is not above 0 and below 100%, as 7%", text));
  }
  return value;
}

class Gate {
 public:
  Gate(const Roster& roster, const GateOptions& options);
  int run();

 private:
  std::vector<GatePair> pairs() const;
  GateKey key_of(const GatePair& pair) const;
  const BaselineRow& expected(const GatePair& pair) const;
  void expect_same_content(const BaselineRow& row, const GatePair& pair) const;
  PairedBatches batches(const GatePair& pair, std::size_t steps) const;
  void check_pair(const GatePair& pair, const BaselineRow& row);
  void write_pair(const GatePair& pair);
  std::string compare_answers(const BaselineRow& row, const GateAnswers& answers) const;
  void report() const;

  const Roster& roster_;
  const GateOptions& options_;
  CheckedSelectors selection_;
  ContestantSpec reference_;
  double tolerance_;
  Workload workload_;
  std::uint64_t mesh_hash_;
  WorkerStage stage_;
  Oracle oracle_;
  Baseline baseline_;
  ProgressLine progress_;
  std::vector<GateLine> lines_;
  std::uint64_t judged_ = 0;
  int status_ = exit_done;
};

Workload workload_for(const GateOptions& options, const CheckedSelectors& selection) {
  const std::string mesh =
      options.selectors.meshes.empty() ? default_scene() : options.selectors.meshes.front();
  const std::vector<std::string>& named = options.selectors.trajectories;
  return make_workload(without_directories(mesh), load_mesh(mesh, options.selectors.normalize), selection,
                       named.empty() ? std::vector<std::string>{"slide"} : named, 5000);
}

WorkerOptions workers_for(const GateOptions& options) {
  WorkerOptions workers = worker_options(options.workers);
  workers.core = core_for_workers();
  workers.calibrate_clock = false;
  return workers;
}

/// An absent file is none yet for those who write it.
Baseline baseline_for(const GateOptions& options) {
  std::error_code ignored;
  if (options.write_baseline && !std::filesystem::exists(options.baseline, ignored)) return {};
  return Baseline::read(options.baseline);
}

CheckedSelectors checked(const GateOptions& options, const Roster& roster) {
  if (options.selectors.detectors.empty())
    throw std::invalid_argument("--detector is missing: what is gated?");
  if (options.rounds < 5 || options.rounds > 1000) {
    throw std::invalid_argument(fmt::format("--rounds \"{}\" is not from 5 to 1000", options.rounds));
  }
  return check(options.selectors, roster);
}

Gate::Gate(const Roster& roster, const GateOptions& options)
    : roster_(roster),
      options_(options),
      selection_(checked(options, roster)),
      reference_(roster.parse(options.reference)),
      tolerance_(checked_tolerance(options.tolerance)),
      workload_(workload_for(options, selection_)),
      mesh_hash_(hash_of(workload_.mesh)),
      stage_(workload_, workers_for(options)),
      oracle_(workload_.mesh),
      baseline_(baseline_for(options)) {}

std::vector<GatePair> Gate::pairs() const {
  std::vector<GatePair> pairs;
  for (std::size_t course = 0; course < workload_.courses.size(); ++course) {
    for (const ContestantSpec& detector : selection_.contestants) {
      pairs.push_back({detector, reference_, course, selection_.queries.front()});
    }
  }
  return pairs;
}

GateKey Gate::key_of(const GatePair& pair) const {
  return {workload_.mesh_name, workload_.trajectories[pair.course], std::string(name_of(pair.query)),
          pair.detector.text(), pair.reference.text()};
}

const BaselineRow& Gate::expected(const GatePair& pair) const {
  const GateKey key = key_of(pair);
  const BaselineRow* const row = baseline_.find(key);
  if (row == nullptr) {
    throw std::invalid_argument(
        fmt::format("{}: no row for {} against {} on {}, {}, {} (--write-baseline adds it)",
                    options_.baseline, key.detector, key.reference, key.mesh, key.trajectory, key.query));
  }
  expect_same_content(*row, pair);
  return *row;
}

void Gate::expect_same_content(const BaselineRow& row, const GatePair& pair) const {
  const auto expect = [&](const char* what, const std::string& name, std::uint64_t then, std::uint64_t now) {
    if (then == now) return;
    throw std::invalid_argument(fmt::format(
        "{}: it was written for another {} \"{}\" (fnv1a {:016x}, now {:016x}); write it anew with "
        "--write-baseline",
        options_.baseline, what, name, then, now));
  };
  expect("mesh", row.key.mesh, row.mesh_hash, mesh_hash_);
  expect("trajectory, radius or reach", row.key.trajectory, row.course_hash,
         hash_of(workload_.courses[pair.course]));
}

PairedBatches Gate::batches(const GatePair& pair, std::size_t steps) const {
  GateEffort effort;
  effort.rounds = options_.rounds;
  return {roster_, workload_, stage_, oracle_, pair, effort, steps, selection_.seed};
}

/// Less work for the same answers is no fault.
std::string Gate::compare_answers(const BaselineRow& row, const GateAnswers& answers) const {
  if (row.checksum && *row.checksum != answers.checksum) return "answers differ";
  if (row.work && (answers.work.mean > row.work->mean || answers.work.max > row.work->max)) {
    return fmt::format("more work: {:.6g} a step, was {:.6g}", answers.work.mean, row.work->mean);
  }
  return row.checksum || row.work ? "same" : "-";
}

void Gate::check_pair(const GatePair& pair, const BaselineRow& row) {
  PairedBatches batches = this->batches(pair, row.steps);
  GateLine line{row.key, row.ratio, {}, "-", ""};
  try {
    line.judgement = judge(row.ratio.ratio, tolerance_, [&] {
      progress_.show(fmt::format("{}: {}", row.key.trajectory, row.key.detector));
      return batches.measure();
    });
    line.answers = compare_answers(row, batches.answers());
    line.verdict = name_of(line.judgement.verdict);
    if (line.answers != "same" && line.answers != "-") line.verdict = "CHANGED";
  } catch (const GateFailure& failure) {
    progress_.clear();
    fmt::print(stderr, "touchmark: {}\n", failure.what());
    line.verdict = "FAILED";
  }
  judged_ += batches.judged();
  const bool failed =
      line.verdict == "FAILED" || line.verdict == "CHANGED" || line.judgement.verdict == Verdict::slower;
  if (failed) {
    status_ = exit_check_failed;
  } else if (line.judgement.verdict == Verdict::inconclusive && status_ == exit_done) {
    status_ = exit_inconclusive;
  }
  lines_.push_back(std::move(line));
}

/// The median over the rounds of two batches whose controls held.
void Gate::write_pair(const GatePair& pair) {
  PairedBatches batches = this->batches(pair, 0);
  GateLine line{key_of(pair), std::nullopt, {}, "-", "inconclusive"};
  std::vector<double> log_ratios;
  int held = 0;
  while (held < 2 && line.judgement.batches < most_batches) {
    progress_.show(fmt::format("{}: {}", line.key.trajectory, line.key.detector));
    line.judgement.batch = batches.measure();
    ++line.judgement.batches;
    if (!control_holds(line.judgement.batch, tolerance_)) continue;
    ++held;
    log_ratios.insert(log_ratios.end(), batches.log_ratios().begin(), batches.log_ratios().end());
  }
  judged_ += batches.judged();
  if (held == 2) {
    line.verdict = "written";
    line.judgement.batch.ratio = median_ratio(log_ratios, selection_.seed);
    baseline_.put({line.key, mesh_hash_, hash_of(workload_.courses[pair.course]), batches.steps(),
                   line.judgement.batch.ratio, batches.answers().work, batches.answers().checksum,
                   build_info().version, build_info().commit, system_info().cpu_model});
  } else {
    status_ = exit_inconclusive;
  }
  lines_.push_back(std::move(line));
}

void Gate::report() const {
  StandardOutput out;
  out.write(fmt::format(
      "times over those of {} in the same rounds, on {}; tolerance {:.3g} %\n{}{} answers judged exactly\n",
      reference_.text(), workload_.mesh_name, 100 * tolerance_, gate_table(lines_), judged_));
  out.finish();
  if (options_.report.empty()) return;
  AtomicFile file(options_.report);
  file.write(gate_csv(lines_, tolerance_));
  file.commit();
}

int Gate::run() {
  std::vector<const BaselineRow*> rows;
  const std::vector<GatePair> pairs = this->pairs();
  if (!options_.write_baseline) {
    for (const GatePair& pair : pairs) rows.push_back(&expected(pair));  // before anything is measured
  }
  watch_for_interrupts();
  restore_denormals();
  try {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      options_.write_baseline ? write_pair(pairs[i]) : check_pair(pairs[i], *rows[i]);
    }
  } catch (const Interrupted&) {
    progress_.clear();
    fmt::print(stderr, "touchmark: interrupted; nothing is judged\n");
    return exit_interrupted;
  } catch (const GateFailure& failure) {  // there is nothing to write a baseline from
    progress_.clear();
    fmt::print(stderr, "touchmark: {}\n", failure.what());
    return exit_check_failed;
  }
  progress_.clear();
  report();
  if (status_ == exit_inconclusive) {
    fmt::print(stderr, "touchmark: inconclusive: {} did not measure equal to itself within {}\n",
               reference_.text(), options_.tolerance);
  }
  if (options_.write_baseline && status_ == exit_done) {
    AtomicFile file(options_.baseline);
    file.write(baseline_.csv());
    file.commit();
  }
  return status_;
}

}  // namespace

void add_gate(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<GateOptions>();
  CLI::App* command = program.add_subcommand(
      "gate", "fail when a detector has become slower, against a reference measured in the same run");
  add_selectors(*command, options->selectors);
  command->add_option("--reference", options->reference, "the contestant whose time is the unit")
      ->type_name("D")
      ->capture_default_str();
  command->add_option("--baseline", options->baseline, "CSV file of ratios; it may come from another machine")
      ->type_name("FILE")
      ->required();
  command->add_flag("--write-baseline", options->write_baseline, "measure, and write the rows of --baseline");
  command->add_option("--tolerance", options->tolerance, "how much slower is not a fault")
      ->type_name("PERCENT")
      ->capture_default_str();
  command->add_option("--rounds", options->rounds, "turns of each contestant in a batch")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--report", options->report, "CSV file of what was found")->type_name("FILE");
  add_worker_selectors(*command, options->workers);
  command->footer(
      "Exit status 0: no slower than the baseline, or by less than the tolerance. 1: slower, and a second "
      "batch\n"
      "agrees; or other answers or more work than in the baseline; or wrong answers. 4: inconclusive, since "
      "the\n"
      "reference, measured twice in every round, did not measure equal to itself.\n"
      "Example: touchmark gate --mesh part.stl --trajectory hand.csv --detector grid-group --baseline "
      "gate.csv "
      "--write-baseline\n"
      "         touchmark gate --mesh part.stl --trajectory hand.csv --detector grid-group --baseline "
      "gate.csv\n");
  command->final_callback([options, &context] { context.status = Gate(context.roster, *options).run(); });
}

}  // namespace touchmark::bench
