#include "bench/workers/timing/throughput.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <benchmark/benchmark.h>

#include "bench/support/system/own_time.h"
#include "bench/workload/sample_steps.h"

namespace touchmark::bench::workers {
namespace {

/// Keeps the one run's times. The library's own reporters write elsewhere, and its CSV one aborts when
/// counters differ.
class KeepTimesPerPass : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.iterations == 0) continue;
      const double passes = static_cast<double>(run.iterations);
      elapsed_ns_ = run.real_accumulated_time * 1e9 / passes;
      cpu_ns_ = run.cpu_accumulated_time * 1e9 / passes;
    }
  }
  double elapsed_ns() const noexcept { return elapsed_ns_; }
  double cpu_ns() const noexcept { return cpu_ns_; }

 private:
  double elapsed_ns_ = 0;
  double cpu_ns_ = 0;
};

/// Compares each pass's answers with the first one's.
class AnswersOfPasses {
 public:
  explicit AnswersOfPasses(Timed& result) : result_(result) {}
  void add(const workload::Checksum& checksum) {
    result_.steady = result_.steady && (first_ || checksum.value() == result_.checksum);
    result_.checksum = checksum.value();
    first_ = false;
  }

 private:
  Timed& result_;
  bool first_ = true;
};

/// Runs `pass` so many times, at least once, and fills in the times of a query.
template <class Pass>
void run_passes(const Pass& pass, std::int64_t passes, double queries_a_pass, Timed& result) {
  const auto run = [&](benchmark::State& state) {
    for (auto _ : state) pass();
  };
  benchmark::ClearRegisteredBenchmarks();
  benchmark::RegisterBenchmark("replay", run)
      ->UseRealTime()
      ->MeasureProcessCPUTime()
      ->Iterations(std::max<std::int64_t>(passes, 1))
      ->Repetitions(1);
  KeepTimesPerPass reporter;
  const long waits = support::waits_so_far();
  benchmark::RunSpecifiedBenchmarks(&reporter, nullptr, "^replay");
  result.ns_per_query = reporter.elapsed_ns() / queries_a_pass;
  // What others do for a contestant that waits for them is not in its own processor time.
  const bool waited = support::waits_so_far() != waits;
  result.cpu_ns_per_query = waited ? result.ns_per_query : reporter.cpu_ns() / queries_a_pass;
}

}  // namespace

std::vector<std::string> initialize_throughput(const std::vector<std::string>& flags) {
  static std::vector<std::string> arguments;  // the library keeps pointers into them
  arguments = flags;
  arguments.insert(arguments.begin(), "touchmark");
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  pointers.push_back(nullptr);
  benchmark::Initialize(&count, pointers.data());
  return {pointers.begin() + 1, pointers.begin() + std::max(count, 1)};
}

Timed measure_throughput(contestants::Contestant& contestant, const workload::QueryTrace& trace,
                         const std::vector<workload::StepRange>& ranges, std::int64_t passes) {
  Timed result;
  AnswersOfPasses answers(result);
  run_passes(
      [&] {
        workload::Checksum checksum;
        for (const workload::StepRange& range : ranges) contestant.replay(trace, range, checksum);
        answers.add(checksum);
      },
      passes, static_cast<double>(workload::steps_in(ranges)), result);
  return result;
}

Timed sample_throughput(contestants::Contestant& contestant, const workload::QueryTrace& trace,
                        const std::vector<workload::StepRange>& ranges, std::int64_t passes,
                        std::int64_t replays) {
  assert(replays == 1 || ranges.size() == 1);
  Timed result;
  AnswersOfPasses answers(result);
  result.samples.reserve(ranges.size() * static_cast<std::size_t>(std::max<std::int64_t>(passes, 1)));
  const auto pass = [&] {
    workload::Checksum checksum;
    for (const workload::StepRange& range : ranges) {
      // So that placing what moves before the first step is in its time, as before every other one.
      contestant.stand_at(trace, range.begin - std::min<std::size_t>(range.begin, 1));
      const support::OwnTime clock;
      for (std::int64_t i = 0; i < replays; ++i) {
        if (i > 0) answers.add(std::exchange(checksum, workload::Checksum()));
        contestant.replay(trace, range, checksum);
      }
      const support::OwnTime::Taken taken = clock.so_far();
      result.samples.push_back(taken.ns / static_cast<double>(replays));
      result.interrupted += taken.interrupted ? 1 : 0;
    }
    answers.add(checksum);
  };
  workload::Checksum unused;
  contestant.replay(trace, ranges.back(), unused);
  run_passes(pass, passes, static_cast<double>(workload::steps_in(ranges)) * static_cast<double>(replays),
             result);
  return result;
}

Timed clock_steps(contestants::Contestant& contestant, const workload::QueryTrace& trace,
                  const std::vector<workload::StepRange>& ranges, OutputBuffers& buffers) {
  const std::span<std::uint64_t> ticks = buffers.ticks(workload::steps_in(ranges));
  const std::span<std::uint64_t> prepare_ticks = buffers.prepare_ticks(ticks.size());
  // No page fault inside a timed step.
  std::ranges::fill(ticks, 0);
  std::ranges::fill(prepare_ticks, 0);
  workload::Checksum checksum;
  std::size_t done = 0;
  const auto start = std::chrono::steady_clock::now();
  for (const workload::StepRange& range : ranges) {
    contestant.replay_clocked(trace, range, checksum, ticks.subspan(done, range.size()),
                              prepare_ticks.subspan(done, range.size()));
    done += range.size();
  }
  const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
  return Timed{elapsed.count() / static_cast<double>(done), 0, checksum.value(), true, {}};
}

}  // namespace touchmark::bench::workers
