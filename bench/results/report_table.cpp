#include "bench/results/report_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

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

/// The names of error_cells.
std::array<std::string, 6> kinds_of_error() {
  return {"missed",   "false",       "triangle", fmt::format("off>{:g}", oracle::physical_tolerance),
          "rounding", "point/normal"};
}

/// "388 false, 156 rounding"; empty where every answer is right to the last digits.
std::string kinds_of_errors(const measurement::ResultRow& row) {
  const std::vector<std::string> counts = error_cells(row);
  const auto names = kinds_of_error();
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (counts[i].empty() || counts[i] == "0") continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[i], names[i]);
  }
  return text;
}

/// A lower bound: one answer may be of several kinds. Nothing if none was judged.
std::optional<std::uint64_t> wrong_answers(const measurement::ResultRow& row) {
  if (!row.counts) return std::nullopt;
  const oracle::ErrorCounts& counts = *row.counts;
  return std::max({counts.missed, counts.false_contacts, counts.wrong_triangle, counts.beyond_tolerance,
                   counts.wrong_point, counts.wrong_normal, counts.wrong_side, counts.malformed});
}

std::string build_ms_of(const measurement::ResultRow& row) {
  return row.build_ms ? figure(*row.build_ms) : "";
}

std::string megabytes_of(const measurement::ResultRow& row) {
  return row.bytes ? fmt::format("{:.1f}", static_cast<double>(*row.bytes) / 1e6) : "";
}

/// At most `most` letters, with ".." for the middle.
std::string cut(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  const std::size_t end = (most - 2) / 2, begin = most - 2 - end;
  return text.substr(0, begin) + ".." + text.substr(text.size() - end);
}

/// "Its slowest warm step took 4.3 us, which holds 1 and 4 kHz, the last with a margin of 58".
std::string rates_held(const std::string& what, double ns) {
  std::string rates;
  double margin = 0;
  for (const int kilohertz : {1, 4, 10}) {
    if (kilohertz * ns > 1e6) break;
    margin = 1e6 / (kilohertz * ns);
    rates += fmt::format("{}{}", rates.empty() ? "" : ", ", kilohertz);
  }
  const std::string taken = fmt::format("{} took {} us", what, figure(ns / 1e3));
  if (rates.empty()) return taken + ", too long for 1 kHz";
  if (const std::size_t last = rates.rfind(", "); last != std::string::npos) rates.replace(last, 2, " and ");
  return fmt::format("{}, which holds {} kHz, the last with a margin of {}", taken, rates, figure(margin));
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
  std::vector<std::string> header{"detector", "guarantee"};
  for (const std::string& kind : kinds_of_error()) header.push_back(kind);
  for (const char* name : {"ns/query", "95 %", "x fastest", "p99.9 ns", "x least p99.9", "max ns", "Hz",
                           "build ms", "MB", "steps"})
    header.emplace_back(name);
  support::Table table(header);
  const Minima least = minima_of(rows);
  for (const measurement::ResultRow& row : rows) {
    std::vector<std::string> cells{row.contestant(), std::string(measurement::guarantee_name(row))};
    for (std::string& cell : error_cells(row)) cells.push_back(std::move(cell));
    for (std::string& cell : timing_cells(row, least)) cells.push_back(std::move(cell));
    cells.push_back(build_ms_of(row));
    cells.push_back(megabytes_of(row));
    cells.push_back(count(row.steps));
    table.add(std::move(cells));
  }
  return table;
}

std::string comparison_text(const std::vector<measurement::ResultRow>& rows) {
  constexpr std::size_t width = 120, min_name = 16, max_status = 24;
  const Minima least = minima_of(rows);
  std::vector<const measurement::ResultRow*> sorted;
  for (const measurement::ResultRow& row : rows) sorted.push_back(&row);
  const auto ns = [](const measurement::ResultRow* row) {
    return row->throughput ? row->throughput->undisturbed.ns : std::numeric_limits<double>::infinity();
  };
  std::ranges::stable_sort(sorted, {}, ns);
  const std::vector<std::string> header{"detector", "guarantee", "wrong",   "ns/query", "95 %", "x fastest",
                                        "p99.9 ns", "max ns",    "cold ns", "build ms", "MB"};
  std::vector<std::vector<std::string>> lines{header};
  std::string notes;
  for (const measurement::ResultRow* row : sorted) {
    const std::vector<std::string> times = timing_cells(*row, least);
    const std::optional<std::uint64_t> wrong = wrong_answers(*row);
    lines.push_back({row->contestant(), std::string(measurement::guarantee_name(*row)),
                     wrong ? count(*wrong) : "", row->throughput ? times[0] : cut(row->status, max_status),
                     times[1], times[2], times[3], times[5], row->cold ? figure(row->cold->p50) : "",
                     build_ms_of(*row), megabytes_of(*row)});
    const std::string kinds = row->throughput ? kinds_of_errors(*row) : row->status;
    if (!kinds.empty()) notes += fmt::format("{}: {}\n", row->contestant(), kinds);
  }
  std::size_t others = 0;
  for (std::size_t i = 1; i < header.size(); ++i) {
    const auto longest =
        std::ranges::max(lines, {}, [i](const std::vector<std::string>& line) { return line[i].size(); });
    others += 2 + longest[i].size();
  }
  const std::size_t name_width = width - std::min(others, width - min_name);
  support::Table table(header);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    lines[i][0] = cut(lines[i][0], name_width);
    table.add(lines[i]);
  }
  return table.text() + notes;
}

std::string overall_verdict(const std::vector<measurement::ResultRow>& rows) {
  struct Sum {
    std::size_t timed = 0, answers = 0;
    double log_ns = 0, max = 0, cold = 0;
    bool is_right = true;
  };
  std::map<std::string, Sum> sums;
  std::size_t trajectories = 0;
  for (const measurement::ResultRow& row : rows) {
    Sum& sum = sums[row.contestant()];
    sum.is_right = sum.is_right && is_exact(row) && wrong_answers(row) == 0u;
    if (!row.throughput || !row.latency || !row.counts) continue;
    trajectories = std::max(trajectories, ++sum.timed);
    sum.answers += row.counts->judged;
    sum.log_ns += std::log(row.throughput->undisturbed.ns);
    sum.max = std::max(sum.max, row.latency->max);
    if (row.cold) sum.cold = std::max(sum.cold, row.cold->max);
  }
  const std::pair<const std::string, Sum>* best = nullptr;
  for (const auto& entry : sums) {
    if (!entry.second.is_right || entry.second.timed < trajectories) continue;
    if (best == nullptr || entry.second.log_ns < best->second.log_ns) best = &entry;
  }
  if (best == nullptr || trajectories == 0)
    return "No contestant finished all trajectories without a wrong answer.\n";
  const auto& [name, sum] = *best;
  std::string text =
      fmt::format("{} is the fastest that was never wrong in {} checked steps: {} ns a query. {}.", name,
                  sum.answers, figure(std::exp(sum.log_ns / static_cast<double>(trajectories))),
                  rates_held("Its slowest warm step", sum.max));
  if (sum.cold > 0)
    text += fmt::format(" {}.", rates_held("With all caches emptied its slowest query", sum.cold));
  return text + '\n';
}

std::string verdict(const std::vector<measurement::ResultRow>& rows,
                    const measurement::Steadiness& steadiness) {
  const measurement::ResultRow* best = measurement::fastest_exact(rows);
  if (best == nullptr) return "no exact contestant was timed\n";
  const measurement::UndisturbedTime& time = best->throughput->undisturbed;
  std::string line = steadiness.conclusive() ? "" : "inconclusive, the control does not tie; ";
  line += fmt::format("fastest exact: {}, {} ns a query [{}, {}] ({} Hz)", best->contestant(),
                      figure(time.ns), figure(time.low), figure(time.high), figure(1e9 / time.ns));
  for (const measurement::ResultRow& row : rows)
    if (&row != best && is_beside(row, *best))
      line += fmt::format("; not told from it: {}, {} ns", row.contestant(),
                          figure(row.throughput->undisturbed.ns));
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
