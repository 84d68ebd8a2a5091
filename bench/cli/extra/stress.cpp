/// `touchmark stress`: families of hard questions to every contestant, each answer against the exact oracle.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/options.h"
#include "bench/cli/plugin_option.h"
#include "bench/cli/report_files.h"
#include "bench/cli/run_frame.h"
#include "bench/cli/single_step.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/roster.h"
#include "bench/contestants/selectors.h"
#include "bench/experiments/stress/stress_csv.h"
#include "bench/experiments/stress/stress_report.h"
#include "bench/experiments/stress/stress_run.h"
#include "bench/results/verification_report.h"
#include "bench/support/checked.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/numbers.h"
#include "bench/support/system/denormals.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::cli {

namespace stress = experiments::stress;

namespace {

constexpr std::uint64_t max_probes = 1'000'000'000;
constexpr std::size_t faults_shown = 20;
/// For a build or a trace: rivals that hang do so in many of them.
constexpr std::chrono::milliseconds stress_timeout{20'000};

struct StressOptions {
  contestants::Selectors selectors;  // of which detectors and seed
  bool sweep_too = false;
  std::vector<std::string> families;
  std::string probes = "1000";
  std::string out, repeat;
  ReportSelectors reports;
  WorkerSelectors workers;
};

std::vector<const stress::Family*> checked_families(const std::vector<std::string>& names) {
  std::vector<const stress::Family*> chosen;
  for (const std::string& name : names) chosen.push_back(&stress::family_named(name));
  if (chosen.empty()) {
    for (const stress::Family& family : stress::families()) chosen.push_back(&family);
  }
  return chosen;
}

stress::StressRequest request_of(const StressOptions& options, const contestants::Roster& roster) {
  const contestants::CheckedSelectors selection =
      contestants::check(options.selectors, roster, contestants::Variety::many);
  stress::StressRequest request;
  request.families = checked_families(options.families);
  request.contestants = selection.contestants;
  request.queries = selection.queries;
  if (!options.sweep_too) std::erase(request.queries, workload::Query::sweep);
  request.seed = selection.seed;
  request.probes = support::checked_count("--probes", options.probes, 1, max_probes);
  request.workers = worker_options(options.workers);
  request.workers.calibrate_clock = false;
  if (options.workers.timeout.empty())
    request.workers.build_timeout = request.workers.request_timeout = stress_timeout;
  return request;
}

class StressCommand {
 public:
  StressCommand(const ProgramContext& context, const StressOptions& options)
      : run_(context.roster, request_of(options, context.roster)),
        frame_(context, options.out),
        junit_(options.reports.junit),
        markdown_(options.reports.markdown) {
    frame_.description.seed = run_.request().seed;
  }

  int run() {
    const bool finished = frame_.finishes(
        [this] { run_.run([this](const std::string& what) { frame_.progress.show(what); }); });
    report();
    if (!finished) return interrupted(run_.scores().size());
    const std::vector<results::Summary> summaries(run_.scores().begin(), run_.scores().end());
    return results::status_of(
        summaries, std::ranges::any_of(summaries, [](const results::Summary& one) { return one.broken; }));
  }

 private:
  void report() {
    const bool finished = frame_.description.finished;
    const std::string faults = results::list_of_failures(run_.faults(), faults_shown);
    const support::Table table = stress::stress_table(run_.scores());
    const std::string legend = stress::stress_legend(run_.scores());
    support::StandardOutput().write(table.text() + legend + (faults.empty() ? "" : "\n" + faults));
    if (finished && junit_.wanted())
      junit_.write(results::junit_xml("touchmark stress", stress::cases_of(run_.scores())));
    if (markdown_.wanted())
      markdown_.write(fmt::format("## touchmark stress{}\n\n{}{}{}", finished ? "" : " (interrupted)",
                                  table.markdown(), code_block(legend), code_block(faults)));
    if (!frame_.folder) return;
    frame_.folder->write_file("stress.csv", stress::stress_csv(frame_.description.run_id, run_.scores()));
    frame_.folder->write_file("run.json", stress::stress_json(frame_.description, run_));
  }

  stress::StressRun run_;
  RunFrame frame_;
  ReportFile junit_, markdown_;
};

/// "QUERY/MESH/COURSE/STEP": one answer of the only family, by the only contestant.
void repeat_one(const StressOptions& options, const contestants::Roster& roster) {
  support::restore_denormals();
  const stress::StressRequest request = request_of(options, roster);
  if (options.families.size() != 1 || options.selectors.detectors.size() != 1)
    throw std::invalid_argument("--repeat needs exactly one --family and one --detector");
  std::istringstream text(options.repeat);
  std::vector<std::string> parts;
  for (std::string part; std::getline(text, part, '/');) parts.push_back(part);
  const std::optional<workload::Query> query =
      parts.size() == 4 ? workload::query_named(parts[0]) : std::nullopt;
  std::vector<std::uint64_t> indices;
  for (std::size_t i = 1; query && i < parts.size(); ++i)
    if (const auto index = support::parse_count(parts[i])) indices.push_back(*index);
  if (indices.size() != 3)
    throw support::bad_value("--repeat", options.repeat, "QUERY/MESH/COURSE/STEP, as nearest/0/0/17");
  const std::vector<workload::Workload> workloads =
      request.families.front()->make(request.seed, request.probes);
  if (indices[0] >= workloads.size() || indices[1] >= workloads[indices[0]].traces.size())
    throw std::invalid_argument(
        fmt::format("--repeat \"{}\" names a mesh or course that is not", options.repeat));
  const workers::Task task{indices[1], *query, workloads[indices[0]].traces[indices[1]].size()};
  support::StandardOutput().write(rows_of_step(roster, workloads[indices[0]], request.workers,
                                               request.contestants.front(), task, indices[2],
                                               SessionBefore::replayed));
}

std::string list_of_families() {
  std::string list = "Families:\n";
  for (const stress::Family& family : stress::families())
    list += fmt::format("  {:<18}{}\n", family.name, family.meaning);
  return list;
}

}  // namespace

void add_stress(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<StressOptions>();
  options->selectors.query = "all";
  CLI::App* command = add_command(program, "stress");
  add_list(
      *command, "--detector", options->selectors.detectors, "D",
      "a contestant (touchmark list) as NAME[:key=value,...]; repeatable; default: those that verify asks");
  add_plugins(*command, context, &options->selectors.detectors);
  add_list(*command, "--family", options->families, "F", "one of those below; repeatable; default: all");
  command->add_flag("--sweep", options->sweep_too,
                    "ask also for the first touch from each probe to the next, besides touches and nearest");
  add_value(*command, "--probes", options->probes, "N", "about how many a family");
  add_value(*command, "--seed", options->selectors.seed, "N", "of all meshes and probes");
  add_value(*command, "--out", options->out, "DIR",
            "folder for stress.csv and run.json; scripts/plot draws them");
  add_value(*command, "--repeat", options->repeat, "QUERY/MESH/COURSE/STEP",
            "instead: the one answer that was told as wrong, as a row of touchmark query");
  add_junit(*command, options->reports);
  add_markdown(*command, options->reports);
  add_worker_selectors(*command, options->workers);
  command->footer(list_of_families() +
                  "Exit status 1 if a contestant that claims exactness is wrong, crashes or does not come "
                  "back; 3 if memory or\n"
                  "another limit of the machine kept one from being judged; 4 if nothing was judged.\n"
                  "Example: touchmark stress --detector grid-group --detector bullet --family needles --out "
                  "results/today\n");
  command->final_callback([options, &context] {
    if (!options->repeat.empty()) return repeat_one(*options, context.roster);
    context.status = StressCommand(context, *options).run();
  });
}

}  // namespace touchmark::bench::cli
