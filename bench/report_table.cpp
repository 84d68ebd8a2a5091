#include "bench/report_table.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "bench/text_table.h"

namespace touchmark::bench {
namespace {

std::string count(std::uint64_t value) { return value == 0 ? "0" : fmt::format("{}", value); }

/// Three significant digits, whole numbers from 100 on.
std::string figure(double value) {
  return value >= 100 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

double fastest_ns(const std::vector<ResultRow>& rows) {
  double fastest = std::numeric_limits<double>::infinity();
  for (const ResultRow& row : rows) {
    if (row.throughput) fastest = std::min(fastest, row.throughput->ns_per_query);
  }
  return fastest;
}

std::vector<std::string> timing_cells(const ResultRow& row, double fastest) {
  if (!row.throughput) return {row.status, "", "", "", ""};
  const double ns = row.throughput->ns_per_query;
  return {figure(ns), row.latency ? figure(row.latency->p999) : "",
          row.latency ? figure(row.latency->max) : "", figure(1e9 / ns), fmt::format("{:.1f}", ns / fastest)};
}

std::vector<std::string> error_cells(const ResultRow& row) {
  if (!row.tally) return {"", "", "", ""};
  const Tally& tally = *row.tally;
  return {count(tally.missed), count(tally.false_contacts), count(tally.wrong_triangle),
          count(answers_off(tally))};
}

bool exact_and_right(const ResultRow& row) {
  return row.throughput && row.accuracy && row.accuracy->guarantee == Guarantee::exact &&
         !row.broke_its_word();
}

}  // namespace

std::string timing_table(const std::vector<ResultRow>& rows) {
  TextTable table({"detector", "guarantee", "missed", "false", "wrong", "off", "ns/query", "p99.9 ns",
                   "max ns", "Hz", "x fastest", "build ms", "MB", "steps"});
  const double fastest = fastest_ns(rows);
  for (const ResultRow& row : rows) {
    std::vector<std::string> cells{row.contestant(), std::string(guarantee_name(row))};
    for (std::string& cell : error_cells(row)) cells.push_back(std::move(cell));
    for (std::string& cell : timing_cells(row, fastest)) cells.push_back(std::move(cell));
    cells.push_back(row.build_ms ? figure(*row.build_ms) : "");
    cells.push_back(row.bytes ? fmt::format("{:.1f}", static_cast<double>(*row.bytes) / 1e6) : "");
    cells.push_back(count(row.steps));
    table.add(std::move(cells));
  }
  return table.text();
}

std::string verdict(const std::vector<ResultRow>& rows) {
  const ResultRow* best = nullptr;
  for (const ResultRow& row : rows) {
    if (!exact_and_right(row)) continue;
    if (best == nullptr || row.throughput->ns_per_query < best->throughput->ns_per_query) best = &row;
  }
  if (best == nullptr) return "no exact contestant was timed\n";
  const double ns = best->throughput->ns_per_query;
  std::string line = fmt::format("fastest exact: {}, {} ns a query ({} Hz)", best->contestant(), figure(ns),
                                 figure(1e9 / ns));
  if (best->latency) {
    const std::size_t misses = best->latency->deadlines[0].misses;
    line += misses == 0 ? fmt::format("; holds 1 kHz: the slowest of {} steps took {} us", best->steps,
                                      figure(best->latency->max / 1e3))
                        : fmt::format("; does not hold 1 kHz: {} of {} steps were late", misses, best->steps);
  }
  return line + '\n';
}

std::string work_table(const std::vector<ResultRow>& rows) {
  TextTable table(
      {"looked at a step", "cells", "spheres", "boxes", "triangles", "of all", "most", "exact decisions"});
  for (const ResultRow& row : rows) {
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

bool tell_faults(const std::vector<ResultRow>& rows,
                 const std::function<std::string(const ResultRow&)>& where) {
  bool faulty = false;
  for (const ResultRow& row : rows) {
    const bool mismatch = row.status == "checksum mismatch";
    if (!mismatch && !row.broke_its_word()) continue;
    faulty = true;
    fmt::print(stderr, "touchmark: {} on {}: {}\n", row.contestant(), where(row),
               mismatch ? "timed answers differ from verified ones" : "answers are not as exact as claimed");
  }
  return faulty;
}

}  // namespace touchmark::bench
