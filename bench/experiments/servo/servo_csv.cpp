#include "bench/experiments/servo/servo_csv.h"

#include <array>

#include <fmt/format.h>

#include "bench/measurement/result_row.h"
#include "bench/results/column.h"
#include "bench/support/table.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::servo {
namespace {

using A = const ServoLine&;
namespace kinds = results::kinds;
using enum results::Presence;
using results::rounded, results::text;
using E = oracle::ErrorCounts;
using R = ServoRow;
using T = TickTally;
using Loop = std::optional<LoopResult> ServoRow::*;
using Times = const measurement::LatencyHistogram& (TickTally::*)() const noexcept;

const ServoRow& row(A asked) { return asked.row; }
const ServoSettings& settings(A asked) { return asked.settings; }

/// The percentile that is `parts` in ten thousand; 10,000 for the maximum.
template <Loop loop, Times times, unsigned parts>
std::string percentile(A asked) {
  const std::optional<LoopResult>& result = asked.row.*loop;
  if (!result) return "";
  const measurement::LatencyHistogram& histogram = (result->tally.*times)();
  constexpr std::uint64_t needed = parts == 9999 ? ticks_for_p9999 : parts == 9990 ? ticks_for_p999 : 1;
  if (histogram.count() < needed) return "";
  return text(parts == 10'000 ? histogram.max_ns() : histogram.percentile(parts / 10'000.0));
}

std::string guarantee(A asked) {
  if (!asked.row.accuracy) return "";
  return std::string(measurement::guarantee_name(asked.row.accuracy->guarantee));
}
std::string bound(A asked) {
  const Misses misses = asked.row.misses();
  return misses.ticks > 0 ? fmt::format("{:.4g}", max_miss_rate(misses.missed, misses.ticks)) : "";
}

constexpr Loop loop = &ServoRow::loop, idle = &ServoRow::idle;
constexpr auto tally = &LoopResult::tally;
constexpr Times latency = &TickTally::latency, query = &TickTally::query;

constexpr results::Kind load_kind{[](std::string_view text) { return load_named(text).has_value(); },
                                  "one of none, memory, cpu"};
constexpr results::Kind verdict_kind{[](std::string_view text) {
                                       return text == name_of(Verdict::holds) ||
                                              text == name_of(Verdict::inconclusive) ||
                                              text == name_of(Verdict::does_not_hold);
                                     },
                                     "one of holds, does not hold, inconclusive"};

constexpr results::Kind question_kind{
    [](std::string_view text) { return text == proxy_step || kinds::query.accepts(text); },
    "one of touches, nearest, sweep, moving, proxy"};
constexpr results::Kind method_kind{[](std::string_view text) { return text == own_proxy; }, "certified"};

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<ServoLine>>({
    {"schema", [](A) { return std::to_string(servo_schema); }, always, kinds::one},
    {"run_id", nullptr, always},
    {"detector", text<row, &R::detector>, always},
    {"options", text<row, &R::options>, optional},
    {"mesh", text<row, &R::mesh>, always},
    {"triangles", text<row, &R::triangles>, always, kinds::whole_number},
    {"trajectory", text<row, &R::trajectory>, always},
    {"query", [](A asked) { return question_of(asked.settings, asked.row.query); }, always, question_kind},
    {"steps", text<row, &R::steps>, always, kinds::whole_number},
    {"radius", text<row, &R::radius>, always, kinds::length},
    {"reach", text<row, &R::reach>, always, kinds::length},
    {"rate_hz", text<settings, &ServoSettings::rate_hz>, always, kinds::positive},
    {"work_us", text<settings, &ServoSettings::work_us>, always, kinds::finite},
    {"load", text<settings, &ServoSettings::load>, always, load_kind},
    {"guarantee", guarantee, optional, kinds::guarantee},
    {"missed", text<row, &R::counts, &E::missed>, optional, kinds::whole_number},
    {"false_contacts", text<row, &R::counts, &E::false_contacts>, optional, kinds::whole_number},
    {"wrong_triangle", text<row, &R::counts, &E::wrong_triangle>, optional, kinds::whole_number},
    {"beyond_bound", text<row, &R::counts, &E::beyond_bound>, optional, kinds::whole_number},
    {"status", text<row, &R::status>, always},
    {"verdict", text<row, &R::verdict>, always, verdict_kind},
    {"ticks", text<row, loop, tally, &T::ticks>, optional, kinds::whole_number},
    {"missed_ticks", text<row, loop, tally, &T::missed>, optional, kinds::whole_number},
    {"lost_ticks", text<row, loop, tally, &T::lost>, optional, kinds::whole_number},
    {"longest_miss_run", text<row, loop, tally, &T::max_run>, optional, kinds::whole_number},
    {"miss_rate_below", bound, optional, kinds::share},
    {"latency_ns_p50", percentile<loop, latency, 5000>, optional, kinds::whole_number},
    {"latency_ns_p99", percentile<loop, latency, 9900>, optional, kinds::whole_number},
    {"latency_ns_p999", percentile<loop, latency, 9990>, optional, kinds::whole_number},
    {"latency_ns_p9999", percentile<loop, latency, 9999>, optional, kinds::whole_number},
    {"latency_ns_max", percentile<loop, latency, 10'000>, optional, kinds::whole_number},
    {"query_ns_p50", percentile<loop, query, 5000>, optional, kinds::whole_number},
    {"query_ns_p99", percentile<loop, query, 9900>, optional, kinds::whole_number},
    {"query_ns_p999", percentile<loop, query, 9990>, optional, kinds::whole_number},
    {"query_ns_p9999", percentile<loop, query, 9999>, optional, kinds::whole_number},
    {"query_ns_max", percentile<loop, query, 10'000>, optional, kinds::whole_number},
    {"work_mean", rounded<6, row, &R::work_mean>, optional, kinds::finite},
    {"work_max", text<row, &R::work_max>, optional, kinds::whole_number},
    {"query_ns_by_work_max", rounded<6, row, &R::ns_by_work_max>, optional, kinds::finite},
    {"minor_faults", text<row, loop, &LoopResult::minor_faults>, optional, kinds::whole_number},
    {"major_faults", text<row, loop, &LoopResult::major_faults>, optional, kinds::whole_number},
    {"involuntary_switches", text<row, loop, &LoopResult::involuntary_switches>, optional,
     kinds::whole_number},
    {"idle_overrun", text<row, idle, &LoopResult::overrun>, optional, kinds::bit},
    {"turns_missed_more", text<row, &R::worse>, always, kinds::whole_number},
    {"turns_idle_missed_more", text<row, &R::idle_worse>, always, kinds::whole_number},
    {"idle_ticks", text<row, idle, tally, &T::ticks>, optional, kinds::whole_number},
    {"idle_missed_ticks", text<row, idle, tally, &T::missed>, optional, kinds::whole_number},
    {"idle_latency_ns_p50", percentile<idle, latency, 5000>, optional, kinds::whole_number},
    {"idle_latency_ns_p99", percentile<idle, latency, 9900>, optional, kinds::whole_number},
    {"idle_latency_ns_p999", percentile<idle, latency, 9990>, optional, kinds::whole_number},
    {"idle_latency_ns_p9999", percentile<idle, latency, 9999>, optional, kinds::whole_number},
    {"idle_latency_ns_max", percentile<idle, latency, 10'000>, optional, kinds::whole_number},
    {"idle_involuntary_switches", text<row, idle, &LoopResult::involuntary_switches>, optional,
     kinds::whole_number},
    {"proxy", [](A asked) { return asked.settings.proxy ? std::string(own_proxy) : ""; }, optional,
     method_kind},
    {"judged_ticks", text<row, &R::proxy, &ProxyCounts::ticks>, optional, kinds::whole_number},
    {"crossings", text<row, &R::proxy, &ProxyCounts::crossings>, optional, kinds::whole_number},
    {"violations", text<row, &R::proxy, &ProxyCounts::violations>, optional, kinds::whole_number},
    {"contact_ticks", text<row, &R::proxy, &ProxyCounts::contact_ticks>, optional, kinds::whole_number},
    {"stuck_ticks", text<row, &R::proxy, &ProxyCounts::stuck_ticks>, optional, kinds::whole_number},
    {"max_work", text<row, &R::proxy, &ProxyCounts::max_work>, optional, kinds::whole_number},
    {"unfinished_ticks", text<row, &R::proxy, &ProxyCounts::unfinished_ticks>, optional, kinds::whole_number},
    {"evicted", text<settings, &ServoSettings::evicts>, always, kinds::bit},
});

/// What ties rows of the three files.
std::vector<std::string> key_of(const ServoRow& row) {
  return {std::to_string(servo_schema), row.detector, row.options, row.trajectory};
}

void add_buckets(support::Table& table, const ServoRow& row, const char* loop_name, const char* time,
                 const measurement::LatencyHistogram& histogram) {
  for (const measurement::LatencyHistogram::Bucket& bucket : histogram.buckets()) {
    std::vector<std::string> fields = key_of(row);
    fields.insert(fields.end(), {loop_name, time, text(bucket.up_to_ns), text(bucket.ticks)});
    table.add(std::move(fields));
  }
}

}  // namespace

std::string question_of(const ServoSettings& settings, workload::Query query) {
  return std::string(settings.proxy ? proxy_step : workload::name_of(query));
}

std::span<const results::Column<ServoLine>> servo_columns() { return columns; }

std::string servo_csv(const std::string& run_id, const ServoSettings& settings,
                      const std::vector<ServoRow>& rows) {
  support::Table table(results::names_of(columns));
  for (const ServoRow& row : rows) table.add(results::fields_of(columns, ServoLine{settings, row}, run_id));
  return table.csv();
}

std::string histogram_csv(const std::vector<ServoRow>& rows) {
  support::Table table({"schema", "detector", "options", "trajectory", "loop", "time", "up_to_ns", "ticks"});
  for (const ServoRow& row : rows) {
    if (row.loop) {
      add_buckets(table, row, "detector", "latency", row.loop->tally.latency());
      add_buckets(table, row, "detector", "query", row.loop->tally.query());
    }
    if (row.idle) add_buckets(table, row, "idle", "latency", row.idle->tally.latency());
  }
  return table.csv();
}

std::string worst_csv(const workload::Workload& workload, const std::vector<ServoRow>& rows) {
  support::Table table({"schema", "detector", "options", "trajectory", "tick", "step", "x", "y", "z",
                        "radius", "latency_ns", "query_ns", "cells", "spheres", "boxes", "triangles",
                        "exact_decisions", "command"});
  for (const ServoRow& row : rows) {
    if (!row.loop) continue;
    for (const WorstTick& worst : row.loop->tally.worst()) {
      const Probe& probe = workload.traces.front()[worst.step].probe;
      std::vector<std::string> fields = key_of(row);
      fields.insert(fields.end(),
                    {text(worst.tick), text(worst.step), text(probe.center.x()), text(probe.center.y()),
                     text(probe.center.z()), text(probe.radius), text(worst.latency_ns),
                     rounded<6>(worst.query_ns), text(worst.work.cells), text(worst.work.spheres),
                     text(worst.work.boxes), text(worst.work.triangles), text(worst.work.exact_decisions),
                     row.repeat.empty() ? "" : row.repeat + text(worst.step)});
      table.add(std::move(fields));
    }
  }
  return table.csv();
}

}  // namespace touchmark::bench::experiments::servo
