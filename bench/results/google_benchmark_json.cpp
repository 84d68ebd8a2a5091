#include "bench/results/google_benchmark_json.h"

#include <cmath>
#include <numeric>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/results/build_info.h"
#include "bench/support/median.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::results {
namespace {

using Json = nlohmann::ordered_json;
using measurement::ResultRow;
using measurement::ThroughputResult;

std::string name_of_case(const ResultRow& row) {
  return fmt::format("{}/{}/{}/{}", row.contestant(), row.mesh, row.trajectory, workload::name_of(row.query));
}

/// The machine's name is left empty.
Json context_of(const RunDescription& run) {
  const benchmark::CPUInfo& cpu = benchmark::CPUInfo::Get();
  Json caches = Json::array();
  for (const benchmark::CPUInfo::CacheInfo& cache : cpu.caches)
    caches.push_back({{"type", cache.type},
                      {"level", cache.level},
                      {"size", cache.size},
                      {"num_sharing", cache.num_sharing}});
  return {{"date", run.system.date},
          {"host_name", ""},
          {"executable", "touchmark"},
          {"num_cpus", cpu.num_cpus},
          {"mhz_per_cpu", std::lround(cpu.cycles_per_second / 1e6)},
          {"cpu_scaling_enabled", cpu.scaling == benchmark::CPUInfo::ENABLED},
          {"caches", caches},
          {"load_avg", run.system.load_average},
#ifdef NDEBUG
          {"library_build_type", "release"},
#else
          {"library_build_type", "debug"},
#endif
          {"touchmark_version", build_info().version},
          {"touchmark_run_id", run.run_id},
          {"touchmark_finished", run.finished}};
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The sample's, as Google Benchmark has it.
double standard_deviation(const std::vector<double>& values) {
  const double center = mean(values);
  double squares = 0;
  for (const double value : values) squares += (value - center) * (value - center);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double variation(const std::vector<double>& values) { return standard_deviation(values) / mean(values); }

/// The entries of one row.
class Family {
 public:
  Family(Json& entries, const ResultRow& row, std::size_t index)
      : entries_(entries), name_(name_of_case(row)), times_(*row.throughput), index_(index) {}

  void add_repetitions() {
    for (std::size_t i = 0; i < times_.each_ns.size(); ++i) {
      Json entry = begun(name_, "iteration");
      entry["repetition_index"] = i;
      entry["threads"] = 1;
      entry["iterations"] = times_.queries;
      add_times(entry, times_.each_ns[i], times_.each_cpu_ns[i]);
    }
  }

  void add_summaries() {
    if (times_.each_ns.size() > 1) {
      add_summary("mean", "time", mean(times_.each_ns), mean(times_.each_cpu_ns));
      add_summary("median", "time", support::median(times_.each_ns), support::median(times_.each_cpu_ns));
      add_summary("stddev", "time", standard_deviation(times_.each_ns),
                  standard_deviation(times_.each_cpu_ns));
      add_summary("cv", "percentage", variation(times_.each_ns), variation(times_.each_cpu_ns));
    }
    add_summary("undisturbed", "time", times_.undisturbed.ns, times_.undisturbed.ns);
  }

 private:
  Json begun(const std::string& name, const char* type) const {
    return {{"name", name},      {"family_index", index_}, {"per_family_instance_index", 0},
            {"run_name", name_}, {"run_type", type},       {"repetitions", times_.each_ns.size()}};
  }

  void add_times(Json& entry, double real_ns, double cpu_ns) {
    entry["real_time"] = real_ns;
    entry["cpu_time"] = cpu_ns;
    entry["time_unit"] = "ns";
    entries_.push_back(std::move(entry));
  }

  void add_summary(const char* what, const char* unit, double real_ns, double cpu_ns) {
    Json entry = begun(fmt::format("{}_{}", name_, what), "aggregate");
    entry["threads"] = 1;
    entry["aggregate_name"] = what;
    entry["aggregate_unit"] = unit;
    entry["iterations"] = times_.each_ns.size();
    add_times(entry, real_ns, cpu_ns);
  }

  Json& entries_;
  std::string name_;
  const ThroughputResult& times_;
  std::size_t index_;
};

}  // namespace

std::string google_benchmark_json(const RunDescription& run, const std::vector<ResultRow>& rows,
                                  Repetitions repetitions) {
  Json entries = Json::array(), failed = Json::array();
  std::size_t families = 0;
  for (const ResultRow& row : rows) {
    if (!row.throughput) {
      failed.push_back({{"name", name_of_case(row)}, {"error_message", row.status}});
      continue;
    }
    Family family(entries, row, families++);
    if (repetitions == Repetitions::each) family.add_repetitions();
    family.add_summaries();
  }
  const Json json{{"context", context_of(run)}, {"benchmarks", entries}, {"failed", failed}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace touchmark::bench::results
