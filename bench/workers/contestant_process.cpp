#include "bench/workers/contestant_process.h"

#include <cstdio>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace touchmark::bench {
namespace {

/// On stderr, in place of a progress line that may be there. Of each contestant once a run, however many
/// meshes it is built of.
void pass_on(const std::vector<std::string>& remarks, const std::string& contestant) {
  static std::set<std::string> told;
  if (remarks.empty() || !told.insert(contestant).second) return;
  const char* const over_progress = isatty(STDERR_FILENO) != 0 ? "\r\x1b[K" : "";
  for (const std::string& text : remarks)
    fmt::print(stderr, "{}touchmark: {}: {}\n", over_progress, contestant, text);
}

}  // namespace

WorkerStage::WorkerStage(const Workload& workload, WorkerOptions options)
    : options_(std::move(options)),
      layout_(layout_of(workload.mesh, workload.courses)),
      input_(write_input(workload.mesh, workload.courses)),
      output_(SharedMemory::create(OutputRoom::bytes_for(layout_.longest_course()))),
      room_(output_.bytes(), layout_.longest_course()) {}

WorkerLaunch WorkerStage::launch(const std::string& program) const {
  return {program,       options_.flags,      input_.descriptor(), output_.descriptor(),
          options_.core, options_.show_output};
}

ContestantProcess::ContestantProcess(const WorkerStage& stage, ContestantSpec spec,
                                     std::string worker_program)
    : stage_(stage), spec_(std::move(spec)), program_(std::move(worker_program)) {}

nlohmann::json ContestantProcess::ask(const nlohmann::json& order, std::chrono::milliseconds patience) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto count_time = [&] { busy_s_ += std::chrono::duration<double>(Clock::now() - start).count(); };
  try {
    nlohmann::json reply = process_->ask(order, patience);
    count_time();
    return reply;
  } catch (const WorkerFailure&) {
    count_time();
    process_.reset();
    throw;
  }
}

void ContestantProcess::start() {
  if (process_ != nullptr) return;
  if (!failed_build_.empty()) throw WorkerFailure(failed_build_);
  const WorkerOptions& options = stage_.options();
  process_ = std::make_unique<WorkerProcess>(stage_.launch(program_));
  try {
    opened_ =
        ask({{"order", "open"}, {"layout", stage_.layout()}, {"calibrate_clock", options.calibrate_clock}},
            options.build_patience);
    const nlohmann::json reply = order_build();
    if (!built_) {
      built_ = reply.get<Built>();
      pass_on(reply.at("remarks").get<std::vector<std::string>>(), spec_.text());
    }
  } catch (const WorkerFailure& failure) {
    failed_build_ = failure.what();
    throw;
  }
  if (built_->refused.empty()) return;
  failed_build_ = "refused: " + built_->refused;
  process_.reset();
  throw WorkerFailure(failed_build_);
}

void ContestantProcess::give_up(std::string status) {
  end();
  failed_build_ = std::move(status);
}

nlohmann::json ContestantProcess::order_build() {
  asked_ = false;
  return ask({{"order", "build"}, {"contestant", spec_.text()}}, stage_.options().build_patience);
}

const Built& ContestantProcess::build() {
  start();
  return *built_;
}

void ContestantProcess::unmake() {
  start();
  if (!built_->builds_lazily || !asked_) return;
  const Built again = order_build().get<Built>();
  if (!again.refused.empty()) throw WorkerFailure("refused: " + again.refused);
}

nlohmann::json ContestantProcess::order(const char* what, const Task& task, const nlohmann::json& more) {
  start();
  asked_ = true;
  nlohmann::json order{{"order", what}, {"task", task}};
  order.update(more);
  return ask(order, stage_.options().order_patience);
}

Timed ContestantProcess::first(const Task& task) { return order("first", task, nlohmann::json::object()); }

Timed ContestantProcess::calibrate(const Task& task, double budget_ns) {
  return order("calibrate", task, {{"budget_ns", budget_ns}});
}

Answered ContestantProcess::answer(const Task& task) {
  return order("answer", task, nlohmann::json::object());
}

Answered ContestantProcess::answer_afresh(const Task& task, std::size_t step) {
  return order("answer_afresh", task, {{"step", step}});
}

Timed ContestantProcess::first_pass(const Task& task) {
  return order("first_pass", task, nlohmann::json::object());
}

Timed ContestantProcess::time(const Task& task, std::int64_t passes) {
  return order("time", task, {{"passes", passes}});
}

Timed ContestantProcess::sample(const Task& task, std::int64_t passes, std::int64_t together) {
  return order("sample", task, {{"passes", passes}, {"together", together}});
}

Timed ContestantProcess::latency(const Task& task) {
  return order("latency", task, nlohmann::json::object());
}

Updated ContestantProcess::update(const Deformation& deformation) {
  start();
  return ask({{"order", "update"}, {"contestant", spec_.text()}, {"deformation", deformation}},
             stage_.options().build_patience);
}

void ContestantProcess::rebuild(const Deformation& deformation) {
  start();
  ask({{"order", "rebuild"}, {"contestant", spec_.text()}, {"deformation", deformation}},
      stage_.options().build_patience);
}

}  // namespace touchmark::bench
