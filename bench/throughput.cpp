#include "bench/throughput.h"

#include <algorithm>

#include <benchmark/benchmark.h>

#include "bench/windows.h"

namespace touchmark::bench {
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

std::uint64_t checksum_of_pass(Contestant& contestant, const Course& course,
                               const std::vector<Window>& windows) {
  Checksum checksum;
  for (const Window& window : windows) contestant.replay(course, window, checksum);
  return checksum.value();
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

Throughput measure_throughput(Contestant& contestant, const Course& course,
                              const std::vector<Window>& windows, std::int64_t passes) {
  Throughput result;
  bool first = true;
  const auto run_passes = [&](benchmark::State& state) {
    for (auto _ : state) {
      const std::uint64_t checksum = checksum_of_pass(contestant, course, windows);
      result.steady = result.steady && (first || checksum == result.checksum);
      result.checksum = checksum;
      first = false;
    }
  };
  benchmark::ClearRegisteredBenchmarks();
  benchmark::RegisterBenchmark("replay", run_passes)
      ->UseRealTime()
      ->MeasureProcessCPUTime()
      ->Iterations(std::max<std::int64_t>(passes, 1))
      ->Repetitions(1);
  KeepTimesPerPass reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter, nullptr, "^replay");
  const auto steps = static_cast<double>(steps_in(windows));
  result.ns_per_query = reporter.elapsed_ns() / steps;
  result.cpu_ns_per_query = reporter.cpu_ns() / steps;
  return result;
}

}  // namespace touchmark::bench
