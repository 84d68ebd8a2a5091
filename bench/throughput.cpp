#include "bench/throughput.h"

#include <algorithm>

#include <benchmark/benchmark.h>

#include "bench/windows.h"

namespace touchmark::bench {
namespace {

/// Keeps the one run's time. The library's own reporters write elsewhere, and its CSV one aborts when
/// counters differ.
class KeepSecondsPerPass : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.iterations == 0) continue;
      seconds_per_pass_ = run.real_accumulated_time / static_cast<double>(run.iterations);
    }
  }
  double seconds_per_pass() const noexcept { return seconds_per_pass_; }

 private:
  double seconds_per_pass_ = 0;
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
      ->Iterations(std::max<std::int64_t>(passes, 1))
      ->Repetitions(1);
  KeepSecondsPerPass reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter, nullptr, "^replay");
  result.ns_per_query = reporter.seconds_per_pass() * 1e9 / static_cast<double>(steps_in(windows));
  return result;
}

}  // namespace touchmark::bench
