/// What `touchmark bench` leaves for other programs beside --out: Google Benchmark's JSON and Markdown.
#pragma once

#include <string>
#include <vector>

#include "bench/cli/benchmark_flags.h"
#include "bench/cli/report_files.h"
#include "bench/measurement/result_row.h"
#include "bench/results/run_json.h"

namespace touchmark::bench::cli {

class BenchReports {
 public:
  /// Opens the files. Throws ResourceError.
  BenchReports(const BenchmarkFlags& flags, const ReportSelectors& selectors);

  /// `verdict` is said under the table of the trajectory's rows.
  void add_trajectory(const std::string& title, const std::vector<measurement::ResultRow>& rows,
                      const std::string& verdict);
  /// Throws ResourceError.
  void write(const results::RunDescription& run, const std::vector<measurement::ResultRow>& rows);

 private:
  ReportFile json_, markdown_;
  bool summed_up_;
  std::string tables_;
};

}  // namespace touchmark::bench::cli
