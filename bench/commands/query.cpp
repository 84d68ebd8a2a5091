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

#include "bench/answer_rows.h"
#include "bench/atomic_file.h"
#include "bench/available_memory.h"
#include "bench/contestant_process.h"
#include "bench/failures.h"
#include "bench/interrupt.h"
#include "bench/program.h"
#include "bench/query_name.h"
#include "bench/roster_options.h"
#include "bench/scenes.h"
#include "bench/selectors.h"
#include "bench/standard_output.h"
#include "bench/worker_options.h"
#include "bench/workload.h"

namespace touchmark::bench {
namespace {

constexpr std::size_t block_size = 1 << 16;  // bytes of rows written at once
constexpr std::string_view refusal_mark = "refused: ";

struct QueryOptions {
  Selectors selectors;
  std::string csv;
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

Workload workload_for(const Selectors& selectors, const Selection& selection) {
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

/// The worker's end as the user caused it, or as the contestant's failure.
[[noreturn]] void explain(const WorkerFailure& failure, const std::string& contestant) {
  const std::string_view what = failure.what();
  if (what.starts_with(refusal_mark)) {
    const std::string_view why = what.substr(refusal_mark.size());
    if (why.starts_with(no_memory)) throw ResourceError(fmt::format("{}: {}", contestant, why));
    throw std::invalid_argument(fmt::format("{}: {}", contestant, why));
  }
  throw ResourceError(fmt::format("{} did not answer: {}", contestant, what));
}

void check_it_answers(const Built& built, Query query, const std::string& contestant) {
  for (const Query known : built.queries) {
    if (known == query) return;
  }
  throw std::invalid_argument(fmt::format("{} does not answer --query {}", contestant, name_of(query)));
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

void run_query(const QueryOptions& options, const Roster& roster) {
  check_there_is_one(options.selectors);
  const Selection selection = check(options.selectors, roster);
  const WorkerOptions workers = patient(options.workers);
  const Query query = selection.queries.front();
  const ContestantSpec& spec = selection.contestants.front();
  const Workload workload = workload_for(options.selectors, selection);
  const std::vector<Step>& course = workload.courses.front();
  RowSink sink(options.csv);  // before the work: a name that cannot be written is known at once

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
  add_worker_selectors(*command, options->workers);
  command->footer(
      "Example: touchmark query --mesh bunny --trajectory approach --detector grid-group --reach inf "
      "--csv answers.csv\n"
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
