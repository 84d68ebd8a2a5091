#include "bench/results/report_table.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "bench/support/median.h"

namespace touchmark::bench::results {
namespace {

std::string count(std::uint64_t value) { return value == 0 ? "0" : fmt::format("{}", value); }

/// Three significant digits, whole numbers from 100 on.
std::string figure(double value) {
  return value >= 100 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

/// The least of the rows' times; infinite where there is none.
struct Minima {
  double ns = std::numeric_limits<double>::infinity();
  double p999 = std::numeric_limits<double>::infinity();
};

Minima minima_of(const std::vector<measurement::ResultRow>& rows) {
  Minima least;
  for (const measurement::ResultRow& row : rows) {
    if (row.throughput) least.ns = std::min(least.ns, row.throughput->undisturbed.ns);
    if (const auto p999 = measurement::p999_of(row, row.latency)) least.p999 = std::min(least.p999, *p999);
  }
  return least;
}

std::vector<std::string> timing_cells(const measurement::ResultRow& row, const Minima& least) {
  if (!row.throughput) return {row.status, "", "", "", "", "", ""};
  const measurement::UndisturbedTime& time = row.throughput->undisturbed;
  const std::optional<double> p999 = measurement::p999_of(row, row.latency);
  return {figure(time.ns),
          fmt::format("{}..{}", figure(time.low), figure(time.high)),
          fmt::format("{:.1f}", time.ns / least.ns),
          p999 ? figure(*p999) : "",
          p999 ? fmt::format("{:.1f}", *p999 / least.p999) : "",
          row.latency ? figure(row.latency->max) : "",
          figure(1e9 / time.ns)};
}

std::vector<std::string> error_cells(const measurement::ResultRow& row) {
  if (!row.counts) return {"", "", "", "", "", ""};
  const oracle::ErrorCounts& counts = *row.counts;
  const std::uint64_t others =
      std::max({counts.wrong_point, counts.wrong_normal, counts.wrong_side}) + counts.malformed;
  return {count(counts.missed),           count(counts.false_contacts), count(counts.wrong_triangle),
          count(counts.beyond_tolerance), count(counts.rounding),       count(others)};
}

/// Empty where there is none. How long a contestant may take is the user's choice, so that a timeout is none.
std::string fault_of(const measurement::ResultRow& row) {
  if (row.status == "checksum mismatch") return "timed answers differ from verified ones";
  if (row.violates_guarantee()) return "answers are not as exact as claimed";
  return row.claims_exactness() && row.status.starts_with("crashed") ? row.status : "";
}

bool is_exact(const measurement::ResultRow& row) {
  return row.accuracy && row.accuracy->guarantee == Guarantee::exact && !row.violates_guarantee();
}

/// Too near to the fastest to be told from it.
bool is_beside(const measurement::ResultRow& row, const measurement::ResultRow& best) {
  return is_exact(row) && row.throughput &&
         row.throughput->undisturbed.ns <= measurement::resolution * best.throughput->undisturbed.ns;
}

std::string min_p999(const std::vector<measurement::ResultRow>& rows) {
  const measurement::ResultRow* least = nullptr;
  for (const measurement::ResultRow& row : rows) {
    if (!is_exact(row) || !measurement::p999_of(row, row.latency)) continue;
    if (least == nullptr || row.latency->p999 < least->latency->p999) least = &row;
  }
  if (least == nullptr) return "";
  return fmt::format("least 99.9 % of exact ones: {}, {} ns\n", least->contestant(),
                     figure(least->latency->p999));
}

std::string disturbance(const measurement::Steadiness& steadiness) {
  std::string line =
      fmt::format("{:.0f} % of the samples were interrupted", 100 * steadiness.disturbed_share);
  if (steadiness.control) {
    const measurement::Control& control = *steadiness.control;
    line += fmt::format("; control: {} once more took {:.2f} times as long [{:.2f}, {:.2f}]{}",
                        control.contestant, control.ratio, control.low, control.high,
                        control.ties() ? "" : ": no tie");
  }
  return line + '\n';
}

}  // namespace

support::Table timing_table(const std::vector<measurement::ResultRow>& rows) {
  const std::string off = fmt::format("off>{:g}", oracle::physical_tolerance);
  support::Table table({"detector", "guarantee", "missed", "false", "triangle", off, "rounding",
                        "point/normal", "ns/query", "95 %", "x fastest", "p99.9 ns", "x least p99.9",
                        "max ns", "Hz", "build ms", "MB", "steps"});
  const Minima least = minima_of(rows);
  for (const measurement::ResultRow& row : rows) {
    std::vector<std::string> cells{row.contestant(), std::string(measurement::guarantee_name(row))};
    for (std::string& cell : error_cells(row)) cells.push_back(std::move(cell));
    for (std::string& cell : timing_cells(row, least)) cells.push_back(std::move(cell));
    cells.push_back(row.build_ms ? figure(*row.build_ms) : "");
    cells.push_back(row.bytes ? fmt::format("{:.1f}", static_cast<double>(*row.bytes) / 1e6) : "");
    cells.push_back(count(row.steps));
    table.add(std::move(cells));
  }
  return table;
}

std::string verdict(const std::vector<measurement::ResultRow>& rows,
                    const measurement::Steadiness& steadiness) {
  const measurement::ResultRow* best = measurement::fastest_exact(rows);
  if (best == nullptr) return "no exact contestant was timed\n";
  const measurement::UndisturbedTime& time = best->throughput->undisturbed;
  std::string line = steadiness.conclusive() ? "" : "inconclusive, the control does not tie; ";
  line += fmt::format("fastest exact: {}, {} ns a query [{}, {}] ({} Hz)", best->contestant(),
                      figure(time.ns), figure(time.low), figure(time.high), figure(1e9 / time.ns));
  for (const measurement::ResultRow& row : rows) {
    if (&row != best && is_beside(row, *best))
      line += fmt::format("; not told from it: {}, {} ns", row.contestant(),
                          figure(row.throughput->undisturbed.ns));
  }
  if (best->latency) {
    const std::size_t misses = best->latency->deadlines[0].misses;
    line += misses == 0 ? fmt::format("; holds 1 kHz: the slowest of {} steps took {} us", best->steps,
                                      figure(best->latency->max / 1e3))
                        : fmt::format("; does not hold 1 kHz: {} of {} steps were late", misses, best->steps);
  }
  return line + '\n' + min_p999(rows) + disturbance(steadiness);
}

std::string cold_table(const std::vector<measurement::ResultRow>& rows) {
  support::Table table({"ns with caches emptied", "warm p50", "L2 p50", "p99", "p99.9", "all p50", "p99",
                        "max", "all/warm", "samples"});
  std::vector<double> floor_l2, floor;
  for (const measurement::ResultRow& row : rows) {
    if (!row.cold || !row.cold_l2 || !row.latency) continue;
    const measurement::ColdSummary &l2 = *row.cold_l2, &all = *row.cold;
    table.add({row.contestant(), figure(row.latency->p50), figure(l2.p50), figure(l2.p99),
               l2.samples >= measurement::steps_for_p999 ? figure(l2.p999) : "", figure(all.p50),
               all.samples >= measurement::samples_for_p99 ? figure(all.p99) : "", figure(all.max),
               fmt::format("{:.1f}", all.p50 / std::max(row.latency->p50, 1e-3)), count(all.samples)});
    floor_l2.push_back(row.cold_floor_l2_ns);
    floor.push_back(row.cold_floor_ns);
  }
  if (table.size() == 0) return "";
  table.add({"nothing asked", "", figure(support::median(floor_l2)), "", "", figure(support::median(floor)),
             "", "", "", ""});
  return table.text();
}

std::string lines_table(const std::vector<measurement::ResultRow>& rows) {
  support::Table table({"cache lines a query touches", "of data", "of code"});
  for (const measurement::ResultRow& row : rows)
    if (row.lines) table.add({row.contestant(), figure(row.lines->data), figure(row.lines->code)});
  return table.size() > 0 ? table.text() : "";
}

std::string work_table(const std::vector<measurement::ResultRow>& rows) {
  support::Table table(
      {"looked at a step", "cells", "spheres", "boxes", "triangles", "of all", "most", "exact decisions"});
  for (const measurement::ResultRow& row : rows) {
    if (!row.work) continue;
    const auto steps = static_cast<double>(row.steps);
    const auto a_step = [&](std::uint64_t total) { return figure(static_cast<double>(total) / steps); };
    const Work& work = row.work->total;
    const double share = static_cast<double>(work.triangles) / steps / static_cast<double>(row.triangles);
    table.add({row.contestant(), a_step(work.cells), a_step(work.spheres), a_step(work.boxes),
               a_step(work.triangles), figure(100 * share) + " %", count(row.work->max),
               count(work.exact_decisions)});
  }
  return table.text();
}

bool print_faults(const std::vector<measurement::ResultRow>& rows,
                  const std::function<std::string(const measurement::ResultRow&)>& where) {
  bool faulty = false;
  for (const measurement::ResultRow& row : rows) {
    const std::string fault = fault_of(row);
    if (fault.empty()) continue;
    faulty = true;
    fmt::print(stderr, "touchmark: {} on {}: {}\n", row.contestant(), where(row), fault);
  }
  return faulty;
}

}  // namespace touchmark::bench::results
