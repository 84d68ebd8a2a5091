/// `touchmark query`: one contestant's answer to every step of one trajectory.
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/program.h"
#include "bench/cli/selector_options.h"
#include "bench/cli/single_step.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/roster_options.h"
#include "bench/results/answer_rows.h"
#include "bench/scenes/scenes.h"
#include "bench/support/atomic_file.h"
#include "bench/support/failures.h"
#include "bench/support/interrupt.h"
#include "bench/support/numbers.h"
#include "bench/support/standard_output.h"
#include "bench/workers/contestant_process.h"
#include "bench/workload/query_name.h"
#include "bench/workload/workload.h"

namespace touchmark::bench {
namespace {

constexpr std::size_t block_size = 1 << 16;  // bytes of rows written at once

struct QueryOptions {
  Selectors selectors;
  std::string csv, step, session = "replayed";
  WorkerSelectors workers;
};

/// Where the rows go: a file that gets its name when it is complete, or standard output.
class RowSink {
 public:
  explicit RowSink(const std::string& path) {
    if (!path.empty()) file_.emplace(path);
  }
  /// False when nobody reads on.
  bool write(std::string_view text) {
    if (!file_) return output_.write(text);
    file_->write(text);
    return true;
  }
  void finish() {
    if (file_) {
      file_->commit();
    } else {
      output_.finish();
    }
  }

 private:
  StandardOutput output_;
  std::optional<AtomicFile> file_;
};

void check_there_is_one(const Selectors& selectors) {
  if (selectors.detectors.size() != 1) {
    throw std::invalid_argument(
        fmt::format("query needs exactly one --detector; {} given", selectors.detectors.size()));
  }
  if (selectors.trajectories.size() > 1) {
    throw std::invalid_argument(
        fmt::format("query follows one --trajectory; {} given", selectors.trajectories.size()));
  }
}

Workload workload_for(const Selectors& selectors, const CheckedSelectors& selection) {
  const std::string mesh = selectors.meshes.empty() ? default_scene() : selectors.meshes.front();
  const std::vector<std::string> slide{"slide"};
  return make_workload(mesh, load_mesh(mesh, selectors.normalize), selection,
                       selectors.trajectories.empty() ? slide : selectors.trajectories, 0);
}

/// A whole trajectory takes a slow contestant its time; there is Ctrl-C, and --timeout where nobody watches.
WorkerOptions patient(const WorkerSelectors& selectors) {
  WorkerOptions options = worker_options(selectors);
  options.calibrate_clock = false;
  if (selectors.timeout.empty()) options.order_patience = std::chrono::hours(24);
  return options;
}

void write_rows(RowSink& sink, Query query, std::span<const Step> course, std::span<const Answer> answers,
                bool with_side) {
  std::string rows = answer_header(query, with_side);
  for (std::size_t i = 0; i < course.size(); ++i) {
    append_answer_row(rows, query, i, course[i], answers[i], with_side);
    if (rows.size() < block_size) continue;
    check_for_interrupt();
    if (!sink.write(rows)) return;
    rows.clear();
  }
  if (sink.write(rows)) sink.finish();
}

std::size_t checked_step(const std::string& text) {
  const std::optional<std::uint64_t> step = parse_count(text);
  if (!step)
    throw std::invalid_argument(fmt::format("--step \"{}\" is not a whole number of 0 or more", text));
  return *step;
}

void run_query(const QueryOptions& options, const Roster& roster) {
  check_there_is_one(options.selectors);
  const CheckedSelectors selection = check(options.selectors, roster);
  const WorkerOptions workers = patient(options.workers);
  const Query query = selection.queries.front();
  const ContestantSpec& spec = selection.contestants.front();
  const Workload workload = workload_for(options.selectors, selection);
  const std::vector<Step>& course = workload.courses.front();
  RowSink sink(options.csv);  // before the work: a name that cannot be written is known at once

  if (!options.step.empty()) {
    const SessionBefore session = options.session == "fresh" ? SessionBefore::fresh : SessionBefore::replayed;
    const std::size_t step = checked_step(options.step);
    if (sink.write(rows_of_step(roster, workload, workers, spec, {0, query, course.size()}, step, session)))
      sink.finish();
    return;
  }
  const WorkerStage stage(workload, workers);
  ContestantProcess process(stage, spec, roster.find(spec.name).worker_program(spec.values));
  try {
    check_it_answers(process.build(), query, spec.text());
    process.answer({0, query, course.size()});
  } catch (const WorkerFailure& failure) {
    explain(failure, spec.text());
  }
  write_rows(sink, query, course, stage.room().answers(course.size()), asks_for_side(spec.values));
}

}  // namespace

void add_query(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<QueryOptions>();
  CLI::App* command =
      program.add_subcommand("query", "one contestant's answer to every step of a trajectory, as CSV");
  add_selectors(*command, options->selectors);
  command->add_option("--csv", options->csv, "where the rows go instead of standard output")
      ->type_name("FILE");
  CLI::Option* step = command->add_option(
      "--step", options->step, "only this step's row, as verify, stress and bench name it; from 0");
  step->type_name("N");
  command
      ->add_option("--session", options->session,
                   "of --step: replayed answers all steps before it first, fresh none; where the other one "
                   "has another "
                   "answer, that is said")
      ->check(CLI::IsMember({"replayed", "fresh"}))
      ->needs(step)
      ->capture_default_str();
  add_worker_selectors(*command, options->workers);
  command->footer(
      "Example: touchmark query --mesh bunny --trajectory approach --detector grid-group --reach inf "
      "--csv answers.csv\n"
      "         touchmark query --mesh part.stl --trajectory hand.csv --columns x=2,y=3,z=4,time_ms=1 --rate "
      "1000 "
      "--detector grid-group\n"
      "With the option side=on (--detector grid-group:side=on) a last column tells inside from outside.\n");
  command->final_callback([options, &context] {
    watch_for_interrupts();
    try {
      run_query(*options, context.roster);
    } catch (const Interrupted&) {
      fmt::print(stderr, "touchmark: interrupted; no rows are kept\n");
      context.status = exit_interrupted;
    }
  });
}

}  // namespace touchmark::bench
