/// `touchmark query`: one contestant's answer to every step of one trajectory.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/cli/options.h"
#include "bench/cli/program.h"
#include "bench/cli/run_frame.h"
#include "bench/cli/selected_workload.h"
#include "bench/cli/selector_options.h"
#include "bench/cli/single_step.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/entry.h"
#include "bench/contestants/roster.h"
#include "bench/meshes/mesh_lists.h"
#include "bench/results/answer_rows.h"
#include "bench/support/checked.h"
#include "bench/support/failures.h"
#include "bench/support/files/atomic_file.h"
#include "bench/support/files/raw_lists.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/files/temporary_file.h"
#include "bench/support/numbers.h"
#include "bench/support/system/beside_this_program.h"
#include "bench/support/system/interrupt.h"
#include "bench/workers/contestant_process.h"
#include "bench/workload/query_name.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::cli {
namespace {

using support::put_list, support::put_text;

void put_trace(std::FILE* to, const std::vector<workload::Step>& trace) {
  std::vector<std::array<double, 5>> steps;
  for (const workload::Step& step : trace) {
    const Vec3& center = step.probe.center;
    steps.push_back({center.x(), center.y(), center.z(), step.probe.radius, step.reach});
  }
  put_list(to, std::span<const std::array<double, 5>>(steps));
}

/// Becomes the program touchmark-tracer, which asks the first trajectory's steps and writes what the detector
/// looked at in these to standard output, as JSON. Throws std::invalid_argument for a step that there is not,
/// a scene of bodies, and where that program is not beside this one; ResourceError where it cannot be run.
[[noreturn]] void print_visits(const workload::Workload& workload, workload::Query query,
                               const std::string& detector, std::vector<std::uint64_t> steps) {
  const std::vector<workload::Step>& trace = workload.traces.front();
  std::ranges::sort(steps);
  if (workload.scene) throw std::invalid_argument("--visits is of a mesh, and does not go with --scene");
  if (steps.back() >= trace.size())
    throw std::invalid_argument(
        fmt::format("--visits \"{}\" is none of the {} steps, which begin at 0", steps.back(), trace.size()));
  std::string program = support::beside_this_program("touchmark-tracer");
  if (!std::filesystem::exists(program))
    throw std::invalid_argument(
        "touchmark-tracer is missing; scripts/build-program touchmark-tracer builds it");
  const support::File input = support::temporary_file();
  meshes::put_mesh(input.get(), workload.mesh);
  put_text(input.get(), workload::name_of(query));
  put_trace(input.get(), trace);
  put_text(input.get(), detector);
  put_list(input.get(), std::span<const std::uint64_t>(steps));
  std::array<char*, 2> arguments{program.data(), nullptr};
  if (std::fflush(input.get()) == 0 && std::ferror(input.get()) == 0 &&
      std::fseek(input.get(), 0, SEEK_SET) == 0 && dup2(fileno(input.get()), STDIN_FILENO) >= 0)
    execv(program.c_str(), arguments.data());
  throw support::ResourceError(
      fmt::format("{} cannot be run, or the folder of temporary files is full", program));
}

constexpr std::size_t block_size = 1 << 16;  // bytes of rows written at once

struct QueryOptions {
  contestants::Selectors selectors;
  std::string csv, step, session = "replayed";
  std::vector<std::uint64_t> visits;
  WorkerSelectors workers;
};

/// Writes the rows: to a file that gets its name when it is complete, or standard output.
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
  support::StandardOutput output_;
  std::optional<support::AtomicFile> file_;
};

void check_there_is_one(const contestants::Selectors& selectors) {
  if (selectors.detectors.size() != 1)
    throw std::invalid_argument(
        fmt::format("query needs exactly one --detector; {} given", selectors.detectors.size()));
  if (selectors.trajectories.size() > 1)
    throw std::invalid_argument(
        fmt::format("query follows one --trajectory; {} given", selectors.trajectories.size()));
}

/// A whole trajectory takes a slow contestant its time; there is Ctrl-C, and --timeout where nobody watches.
workers::WorkerOptions patient(const WorkerSelectors& selectors) {
  workers::WorkerOptions options = worker_options(selectors);
  options.calibrate_clock = false;
  if (selectors.timeout.empty()) options.request_timeout = std::chrono::hours(24);
  return options;
}

void write_rows(RowSink& sink, workload::Query query, std::span<const workload::Step> trace,
                std::span<const workload::Answer> answers, const results::AnswerColumns& columns) {
  std::string rows = results::answer_header(query, columns);
  for (std::size_t i = 0; i < trace.size(); ++i) {
    results::append_answer_row(rows, query, i, trace[i], answers[i], columns);
    if (rows.size() < block_size) continue;
    support::check_for_interrupt();
    if (!sink.write(rows)) return;
    rows.clear();
  }
  if (sink.write(rows)) sink.finish();
}

std::size_t checked_step(const std::string& text) {
  const std::optional<std::uint64_t> step = support::parse_count(text);
  if (!step) throw support::bad_value("--step", text, "a whole number of 0 or more");
  return *step;
}

void run_query(const QueryOptions& options, const contestants::Roster& roster) {
  check_there_is_one(options.selectors);
  const contestants::CheckedSelectors selection = contestants::check(options.selectors, roster);
  const workers::WorkerOptions workers = patient(options.workers);
  const workload::Query query = selection.queries.front();
  const contestants::ContestantSpec& spec = selection.contestants.front();
  const workload::Workload workload = workload_of(options.selectors, mesh_of(options.selectors), selection,
                                                  or_else(options.selectors.trajectories, {"slide"}), 0);
  const std::vector<workload::Step>& trace = workload.traces.front();
  if (!options.visits.empty()) print_visits(workload, query, spec.text(), options.visits);
  RowSink sink(options.csv);  // before the work: a name that cannot be written is known at once

  if (!options.step.empty()) {
    const SessionBefore session = options.session == "fresh" ? SessionBefore::fresh : SessionBefore::replayed;
    const std::size_t step = checked_step(options.step);
    if (sink.write(rows_of_step(roster, workload, workers, spec, {0, query, trace.size()}, step, session)))
      sink.finish();
    return;
  }
  const workers::SharedArena arena(workload, workers);
  workers::ContestantProcess process(arena, spec, roster.find(spec.name).worker_program(spec.values));
  try {
    check_it_answers(process.build(), query, spec.text());
    process.ask(workers::request::Answer{{0, query, trace.size()}});
  } catch (const workers::WorkerFailure& failure) {
    explain(failure, spec.text());
  }
  write_rows(sink, query, trace, arena.buffers().answers(trace.size()),
             {contestants::asks_for_side(spec.values), workload.scene.get()});
}

}  // namespace

void add_query(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<QueryOptions>();
  CLI::App* command = add_command(program, "query");
  add_selectors(*command, context, options->selectors);
  add_scene_selectors(*command, options->selectors);
  add_unit(*command, options->selectors.unit);
  add_value(*command, "--csv", options->csv, "FILE", "where the rows go instead of standard output");
  CLI::Option* step = command->add_option(
      "--step", options->step, "only this step's row, as verify, stress and bench name it; from 0");
  step->type_name("N");
  command
      ->add_option("--session", options->session,
                   "of --step: replayed answers all steps before it first, fresh none; where the other one "
                   "has another answer, that is said")
      ->check(CLI::IsMember({"replayed", "fresh"}))
      ->needs(step)
      ->capture_default_str();
  add_value(*command, "--visits", options->visits, "N",
            "instead of rows, what one of ours looked at in these steps, as 3,7,12; as JSON")
      ->delimiter(',')
      ->excludes(step)
      ->excludes("--csv");
  add_worker_selectors(*command, options->workers);
  command->footer(
      "Example: touchmark query --mesh bunny --trajectory approach --detector grid-group --reach inf --csv "
      "answers.csv\n"
      "         touchmark query --mesh part.stl --trajectory hand.csv --columns x=2,y=3,z=4,time_ms=1 --rate "
      "1000 --detector grid-group\n"
      "         touchmark query --scene parts.json --poses parts.csv --detector sphere-cluster --trajectory "
      "hand.csv\n"
      "With --scene a last column names the body.\n"
      "With the option side=on (--detector grid-group:side=on) a last column tells inside from outside.\n");
  command->final_callback([options, &context] {
    support::watch_for_interrupts();
    try {
      run_query(*options, context.roster);
    } catch (const support::Interrupted&) {
      context.status = interrupted("no rows are kept");
    }
  });
}

}  // namespace touchmark::bench::cli
