#include "bench/workers/contestant_process.h"

#include <cstdio>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace touchmark::bench::workers {
namespace {

/// On stderr, in place of a progress line that may be there. Of each contestant once a run, however many
/// meshes it is built of.
void pass_on(const std::vector<std::string>& remarks, const std::string& contestant) {
  static std::set<std::string> reported;
  if (remarks.empty() || !reported.insert(contestant).second) return;
  const char* const over_progress = isatty(STDERR_FILENO) != 0 ? "\r\x1b[K" : "";
  for (const std::string& text : remarks)
    fmt::print(stderr, "{}touchmark: {}: {}\n", over_progress, contestant, text);
}

}  // namespace

SharedArena::SharedArena(const workload::Workload& workload, WorkerOptions options,
                         std::size_t min_output_steps)
    : options_(std::move(options)),
      layout_(layout_of(workload, min_output_steps)),
      input_(write_input(workload)),
      output_(SharedMemory::create(OutputBuffers::bytes_for(layout_.output_steps()))),
      buffers_(output_.bytes(), layout_.output_steps()) {}

WorkerLaunch SharedArena::launch(const std::string& program) const {
  return {
      program, options_.flags, input_.descriptor(), output_.descriptor(), options_.core, options_.show_output,
      {}};
}

ContestantProcess::ContestantProcess(const SharedArena& arena, contestants::ContestantSpec spec,
                                     std::string worker_program)
    : arena_(arena), spec_(std::move(spec)), program_(std::move(worker_program)) {}

Reply ContestantProcess::exchange(const Request& request, std::chrono::milliseconds timeout) {
  const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  const auto count_time = [&] {
    busy_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  try {
    Reply reply = process_->ask(request, timeout);
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
  const WorkerOptions& options = arena_.options();
  process_ = std::make_unique<WorkerProcess>(arena_.launch(program_));
  try {
    opened_ = std::get<Opened>(
        exchange(request::Open{arena_.layout(), options.calibrate_clock}, options.build_timeout));
    Built built = request_build();
    if (!built_) {
      pass_on(built.remarks, spec_.text());
      built_ = std::move(built);
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

void ContestantProcess::mark_failed(std::string status) {
  end();
  failed_build_ = std::move(status);
}

Built ContestantProcess::request_build() {
  asked_ = false;
  return std::get<Built>(
      exchange(request::Build{spec_.text(), spec_.plugin}, arena_.options().build_timeout));
}

const Built& ContestantProcess::build() {
  start();
  return *built_;
}

CacheLines ContestantProcess::count_cache_lines(const Task& task, std::size_t samples) const {
  constexpr int slower = 50;  // than without valgrind, at the most
  const CountsFolder folder;
  WorkerLaunch launch = arena_.launch(program_);
  launch.under = counting_program(folder.counts());
  WorkerProcess counted(launch);
  const std::chrono::milliseconds timeout = slower * arena_.options().build_timeout;
  counted.ask(request::Open{arena_.layout(), false}, timeout);
  const auto built = std::get<Built>(counted.ask(request::Build{spec_.text(), spec_.plugin}, timeout));
  if (!built.refused.empty()) throw WorkerFailure("refused: " + built.refused);
  counted.ask(request::Lines{task, samples}, timeout);
  return counted_lines(folder.counts(), samples);
}

void ContestantProcess::rebuild_if_lazy() {
  start();
  if (!built_->builds_lazily || !asked_) return;
  const Built again = request_build();
  if (!again.refused.empty()) throw WorkerFailure("refused: " + again.refused);
}

}  // namespace touchmark::bench::workers
