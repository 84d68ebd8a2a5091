#include "bench/cli/commands/bench_reports.h"

#include <fmt/format.h>

#include "bench/results/google_benchmark_json.h"
#include "bench/results/report_table.h"
#include "bench/results/verification_report.h"

namespace touchmark::bench::cli {

BenchReports::BenchReports(const BenchmarkFlags& flags, const ReportSelectors& selectors)
    : json_(flags.list_tests ? "" : flags.out),
      markdown_(flags.list_tests ? "" : selectors.markdown),
      summed_up_(flags.aggregates_only) {}

void BenchReports::add_trajectory(const std::string& title, const std::vector<measurement::ResultRow>& rows,
                                  const std::string& verdict) {
  tables_ +=
      fmt::format("\n### {}\n\n{}{}", title, results::timing_table(rows).markdown(), code_block(verdict));
}

void BenchReports::write(const results::RunDescription& run,
                         const std::vector<measurement::ResultRow>& rows) {
  if (json_.wanted()) {
    using results::Repetitions;
    json_.write(
        results::google_benchmark_json(run, rows, summed_up_ ? Repetitions::summed_up : Repetitions::each));
  }
  if (markdown_.wanted())
    markdown_.write(fmt::format("## touchmark bench{}\n{}\n{}", run.finished ? "" : " (interrupted)", tables_,
                                results::judged_answers(rows)));
}

}  // namespace touchmark::bench::cli
