#include "bench/regression/gate/gate_report.h"

#include <fmt/format.h>

#include "bench/results/column.h"

namespace touchmark::bench::regression::gate {
namespace {

std::string text_of(const RatioInterval& interval) {
  return fmt::format("{:.3f}..{:.3f}", interval.low, interval.high);
}

std::string change_in(const GateLine& line) {
  if (!line.baseline) return "-";
  return fmt::format("{:+.1f} %", 100 * (line.judgement.batch.ratio.ratio / line.baseline->ratio - 1));
}

std::vector<std::string> cells_of(const GateLine& line) {
  const auto& [ratio, control] = line.judgement.batch;
  const std::string baseline = line.baseline ? fmt::format("{:.4g}", line.baseline->ratio) : "-";
  const std::string batches = std::to_string(line.judgement.batches);
  if (line.judgement.batches == 0)
    return {line.key.trajectory, line.key.detector, baseline, "-", "-", "-", "-", batches,
            line.answers,        line.verdict};
  return {line.key.trajectory, line.key.detector, baseline,         fmt::format("{:.4g}", ratio.ratio),
          text_of(ratio),      change_in(line),   text_of(control), batches,
          line.answers,        line.verdict};
}

}  // namespace

support::Table gate_table(const std::vector<GateLine>& lines) {
  support::Table table({"trajectory", "detector", "baseline", "ratio", "interval", "change", "control",
                        "batches", "answers", "verdict"});
  for (const GateLine& line : lines) table.add(cells_of(line));
  return table;
}

std::vector<results::TestCase> cases_of(const std::vector<GateLine>& lines) {
  std::vector<results::TestCase> cases;
  for (const GateLine& line : lines) {
    results::TestCase& one = cases.emplace_back();
    one.group = line.key.detector;
    one.name = fmt::format("{}/{}/{}", line.key.mesh, line.key.trajectory, line.key.query);
    one.seconds = line.seconds;
    if (line.failed) one.outcome = results::Outcome::failed;
    if (line.verdict == name_of(Verdict::inconclusive)) one.outcome = results::Outcome::skipped;
    if (one.outcome != results::Outcome::passed)
      one.message = fmt::format("{}, {} against {}; answers: {}", line.verdict, change_in(line),
                                line.key.reference, line.answers);
  }
  return cases;
}

std::string gate_csv(const std::vector<GateLine>& lines, double tolerance) {
  std::string csv =
      "mesh,trajectory,query,detector,reference,baseline_ratio,ratio,ratio_low,ratio_high,control_low,"
      "control_high,batches,tolerance,answers,verdict\n";
  for (const GateLine& line : lines) {
    const auto& [ratio, control] = line.judgement.batch;
    const auto measured = [&](double value) {
      return line.judgement.batches == 0 ? "" : fmt::format("{:.6g}", value);
    };
    csv += support::csv_line(
        {line.key.mesh, line.key.trajectory, line.key.query, line.key.detector, line.key.reference,
         line.baseline ? fmt::format("{:.6g}", line.baseline->ratio) : "", measured(ratio.ratio),
         measured(ratio.low), measured(ratio.high), measured(control.low), measured(control.high),
         std::to_string(line.judgement.batches), fmt::format("{}", tolerance), line.answers, line.verdict});
  }
  return csv;
}

}  // namespace touchmark::bench::regression::gate
