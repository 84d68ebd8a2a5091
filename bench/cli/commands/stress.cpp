/// `touchmark stress`: families of hard questions to every contestant, each answer against the exact oracle.
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/program.h"
#include "bench/cli/single_step.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/selectors.h"
#include "bench/experiments/stress/stress_csv.h"
#include "bench/experiments/stress/stress_report.h"
#include "bench/experiments/stress/stress_run.h"
#include "bench/results/results_folder.h"
#include "bench/results/verification_report.h"
#include "bench/support/denormals.h"
#include "bench/support/interrupt.h"
#include "bench/support/numbers.h"
#include "bench/support/progress.h"
#include "bench/support/standard_output.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench {
namespace {

constexpr std::uint64_t most_probes = 1'000'000'000;
constexpr std::size_t faults_shown = 20;
/// For a build or a course: rivals that hang do so in many of them.
constexpr std::chrono::milliseconds stress_patience{20'000};

struct StressOptions {
  Selectors selectors;  // of which detectors and seed
  bool sweep_too = false;
  std::vector<std::string> families;
  std::string probes = "1000";
  std::string out, repeat;
  WorkerSelectors workers;
};

std::size_t checked_probes(const std::string& text) {
  const std::optional<std::uint64_t> probes = parse_count(text);
  if (!probes || *probes < 1 || *probes > most_probes) {
    throw std::invalid_argument(
        fmt::format("--probes \"{}\" is not a whole number from 1 to {}", text, most_probes));
  }
  return *probes;
}

std::vector<const Family*> checked_families(const std::vector<std::string>& names) {
  std::vector<const Family*> chosen;
  for (const std::string& name : names) chosen.push_back(&family_named(name));
  if (chosen.empty()) {
    for (const Family& family : families()) chosen.push_back(&family);
  }
  return chosen;
}

StressRequest request_of(const StressOptions& options, const Roster& roster) {
  const CheckedSelectors selection = check(options.selectors, roster, Variety::many);
  StressRequest request;
  request.families = checked_families(options.families);
  request.contestants = selection.contestants;
  request.queries = selection.queries;
  if (!options.sweep_too) std::erase(request.queries, Query::sweep);
  request.seed = selection.seed;
  request.probes = checked_probes(options.probes);
  request.workers = worker_options(options.workers);
  request.workers.calibrate_clock = false;
  if (options.workers.timeout.empty())
    request.workers.build_patience = request.workers.order_patience = stress_patience;
  return request;
}

/// As that of rows, see verification_report.h.
int status_of(const std::vector<Score>& scores) {
  std::map<std::string, std::uint64_t> judged;
  std::map<std::string, std::string> short_of_memory;
  std::uint64_t all_judged = 0;
  for (const Score& score : scores) {
    if (score.broken) return exit_check_failed;
    all_judged += score.tally.judged;
    judged[score.contestant()] += score.tally.judged;
    if (!score.short_of_memory.empty()) short_of_memory.emplace(score.contestant(), score.short_of_memory);
  }
  int status = exit_done;
  for (const auto& [contestant, why] : short_of_memory) {
    if (judged[contestant] > 0) continue;
    fmt::print(stderr, "touchmark: {}: nothing judged: {}\n", contestant, why);
    status = exit_resources;
  }
  if (status != exit_done || all_judged > 0) return status;
  fmt::print(stderr, "touchmark: inconclusive: 0 answers were judged\n");
  return exit_inconclusive;
}

class StressCommand {
 public:
  StressCommand(const ProgramContext& context, const StressOptions& options)
      : run_(context.roster, request_of(options, context.roster)),
        description_(begun_run(context.argc, context.argv)) {
    if (!options.out.empty()) folder_.emplace(options.out);
    description_.flushed_to_zero = restore_denormals();
    description_.seed = run_.request().seed;
  }

  int run();

 private:
  void report(bool finished);

  StressRun run_;
  std::optional<ResultsFolder> folder_;
  RunDescription description_;
  ProgressLine progress_;
};

void StressCommand::report(bool finished) {
  progress_.clear();
  const std::string faults = list_of_failures(run_.faults(), faults_shown);
  StandardOutput().write(stress_table(run_.scores()) + (faults.empty() ? "" : "\n" + faults));
  if (!folder_) return;
  description_.finished = finished;
  folder_->write_file("stress.csv", stress_csv(description_.run_id, run_.scores()));
  folder_->write_file("run.json", stress_json(description_, run_));
}

int StressCommand::run() {
  watch_for_interrupts();
  try {
    run_.run([&](const std::string& what) { progress_.show(what); });
  } catch (const Interrupted&) {
    report(false);
    fmt::print(stderr, "touchmark: interrupted; {} finished rows are kept\n", run_.scores().size());
    return exit_interrupted;
  }
  report(true);
  return status_of(run_.scores());
}

/// "QUERY/MESH/COURSE/STEP": one answer of the only family, by the only contestant.
void repeat_one(const StressOptions& options, const Roster& roster) {
  const StressRequest request = request_of(options, roster);
  if (options.families.size() != 1 || options.selectors.detectors.size() != 1) {
    throw std::invalid_argument("--repeat needs exactly one --family and one --detector");
  }
  std::istringstream text(options.repeat);
  std::vector<std::string> parts;
  for (std::string part; std::getline(text, part, '/');) parts.push_back(part);
  const std::optional<Query> query = parts.size() == 4 ? query_named(parts[0]) : std::nullopt;
  std::vector<std::uint64_t> places;
  for (std::size_t i = 1; query && i < parts.size(); ++i) {
    if (const auto place = parse_count(parts[i])) places.push_back(*place);
  }
  if (places.size() != 3) {
    throw std::invalid_argument(
        fmt::format("--repeat \"{}\" is not QUERY/MESH/COURSE/STEP, as nearest/0/0/17", options.repeat));
  }
  const std::vector<Workload> workloads = request.families.front()->make(request.seed, request.probes);
  if (places[0] >= workloads.size() || places[1] >= workloads[places[0]].courses.size()) {
    throw std::invalid_argument(
        fmt::format("--repeat \"{}\" names a mesh or course that is not", options.repeat));
  }
  const Task task{places[1], *query, workloads[places[0]].courses[places[1]].size()};
  StandardOutput().write(rows_of_step(roster, workloads[places[0]], request.workers,
                                      request.contestants.front(), task, places[2], SessionBefore::replayed));
}

std::string list_of_families() {
  std::string list = "Families:\n";
  for (const Family& family : families()) list += fmt::format("  {:<18}{}\n", family.name, family.meaning);
  return list;
}

}  // namespace

void add_stress(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<StressOptions>();
  options->selectors.query = "all";
  CLI::App* command =
      program.add_subcommand("stress", "hard questions of many kinds, every answer against the exact oracle");
  const auto repeatable = [&](const char* name, std::vector<std::string>& values, const char* what,
                              const char* type) {
    command->add_option(name, values, what)->type_name(type)->expected(1)->take_all();
  };
  repeatable(
      "--detector", options->selectors.detectors,
      "a contestant (touchmark list) as NAME[:key=value,...]; repeatable; default: those that verify asks",
      "D");
  repeatable("--family", options->families, "one of those below; repeatable; default: all", "F");
  command->add_flag("--sweep", options->sweep_too,
                    "ask also for the first touch from each probe to the next, besides touches and nearest");
  command->add_option("--probes", options->probes, "about how many a family")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--seed", options->selectors.seed, "of all meshes and probes")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--out", options->out, "folder for stress.csv and run.json; scripts/plot draws them")
      ->type_name("DIR");
  command
      ->add_option("--repeat", options->repeat,
                   "instead: the one answer that was told as wrong, as a row of touchmark query")
      ->type_name("QUERY/MESH/COURSE/STEP");
  add_worker_selectors(*command, options->workers);
  command->footer(list_of_families() +
                  "Exit status 1 if a contestant that claims exactness is wrong, crashes or does not come "
                  "back; 3 if memory or\n"
                  "another limit of the machine kept one from being judged; 4 if nothing was judged.\n"
                  "Example: touchmark stress --detector grid-group --detector bullet --family needles --out "
                  "results/today\n");
  command->final_callback([options, &context] {
    restore_denormals();
    if (!options->repeat.empty()) return repeat_one(*options, context.roster);
    context.status = StressCommand(context, *options).run();
  });
}

}  // namespace touchmark::bench
