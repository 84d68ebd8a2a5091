#include "bench/cli/single_step.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "bench/contestants/entry.h"
#include "bench/results/answer_rows.h"
#include "bench/support/failures.h"
#include "bench/support/system/available_memory.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::cli {
namespace {

constexpr std::string_view refusal_mark = "refused: ";

}  // namespace

/// The worker's end as the user caused it, or as the contestant's failure.
[[noreturn]] void explain(const workers::WorkerFailure& failure, const std::string& contestant) {
  const std::string_view what = failure.what();
  if (what.starts_with(refusal_mark)) {
    const std::string_view why = what.substr(refusal_mark.size());
    if (why.starts_with(support::no_memory))
      throw support::ResourceError(fmt::format("{}: {}", contestant, why));
    throw std::invalid_argument(fmt::format("{}: {}", contestant, why));
  }
  throw support::ResourceError(fmt::format("{} did not answer: {}", contestant, what));
}

void check_it_answers(const workers::Built& built, workload::Query query, const std::string& contestant) {
  for (const workload::Query known : built.queries)
    if (known == query) return;
  throw std::invalid_argument(
      fmt::format("{} does not answer --query {}", contestant, workload::name_of(query)));
}

std::string rows_of_step(const contestants::Roster& roster, const workload::Workload& workload,
                         const workers::WorkerOptions& workers, const contestants::ContestantSpec& spec,
                         const workers::Task& task, std::size_t step, SessionBefore session) {
  const std::vector<workload::Step>& trace = workload.traces[task.trace];
  if (step >= trace.size())
    throw std::invalid_argument(
        fmt::format("--step \"{}\" is none of the {} steps, which begin at 0", step, trace.size()));
  // No later step: it might be one that the contestant does not survive.
  workload::Workload until = workload;
  until.trajectories = {workload.trajectories[task.trace]};
  until.traces.assign(
      1, std::vector<workload::Step>(trace.begin(), trace.begin() + static_cast<std::ptrdiff_t>(step) + 1));
  if (workload.scene) until.schedules = {scenes::beginning(workload.schedules[task.trace], step + 1)};
  const workers::Task all{0, task.query, step + 1};
  const workers::SharedArena arena(until, workers);
  workers::ContestantProcess process(arena, spec, roster.find(spec.name).worker_program(spec.values));
  const results::AnswerColumns columns{contestants::asks_for_side(spec.values), workload.scene.get()};
  std::string replayed, fresh;
  try {
    check_it_answers(process.build(), task.query, spec.text());
    process.ask(workers::request::Answer{all});
    results::append_answer_row(replayed, task.query, step, trace[step],
                               arena.buffers().answers(step + 1)[step], columns);
    process.ask(workers::request::AnswerAfresh{all, step});
    results::append_answer_row(fresh, task.query, step, trace[step], arena.buffers().answers(1).front(),
                               columns);
  } catch (const workers::WorkerFailure& failure) {
    explain(failure, spec.text());
  }
  const bool wants_fresh = session == SessionBefore::fresh;
  if (replayed != fresh)
    fmt::print(stderr, "touchmark: {} answers otherwise with {}: {}", spec.text(),
               wants_fresh ? "the session replayed from the start" : "a fresh session",
               wants_fresh ? replayed : fresh);
  return results::answer_header(task.query, columns) + (wants_fresh ? fresh : replayed);
}

}  // namespace touchmark::bench::cli
