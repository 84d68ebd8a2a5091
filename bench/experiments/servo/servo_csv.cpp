#include "bench/experiments/servo/servo_csv.h"

#include <array>

#include <fmt/format.h>

#include "bench/measurement/result_row.h"
#include "bench/results/column.h"
#include "bench/support/table.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::servo {
namespace {

template <class Number>
std::string count(Number value) {
  return fmt::format("{}", value);
}
std::string rounded(double value) { return fmt::format("{:.6g}", value); }
std::string counted(const std::optional<double>& value) { return value ? rounded(*value) : ""; }

using A = const ServoLine&;
namespace kinds = results::kinds;
using enum results::Presence;
using Loop = std::optional<LoopResult> ServoRow::*;
using Times = const measurement::LatencyHistogram& (TickTally::*)() const noexcept;

template <Loop loop, auto Value>
std::string of_tally(A asked) {
  const std::optional<LoopResult>& result = asked.row.*loop;
  return result ? count((result->tally.*Value)()) : "";
}
template <Loop loop, auto Member>
std::string of_kernel(A asked) {
  const std::optional<LoopResult>& result = asked.row.*loop;
  return result ? count(static_cast<std::uint64_t>((*result).*Member)) : "";
}
/// The percentile that is `parts` in ten thousand; 10,000 for the maximum.
template <Loop loop, Times times, unsigned parts>
std::string percentile(A asked) {
  const std::optional<LoopResult>& result = asked.row.*loop;
  if (!result) return "";
  const measurement::LatencyHistogram& histogram = (result->tally.*times)();
  constexpr std::uint64_t needed = parts == 9999 ? ticks_for_p9999 : parts == 9990 ? ticks_for_p999 : 1;
  if (histogram.count() < needed) return "";
  return count(parts == 10'000 ? histogram.max_ns() : histogram.percentile(parts / 10'000.0));
}
template <auto Member>
std::string of_counts(A asked) {
  return asked.row.counts ? count((*asked.row.counts).*Member) : "";
}

template <auto Member>
std::string of_proxy(A asked) {
  return asked.row.proxy ? count((*asked.row.proxy).*Member) : "";
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
    "one of touches, nearest, sweep, proxy"};
constexpr results::Kind method_kind{[](std::string_view text) { return text == own_proxy; }, "certified"};

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<ServoLine>>({
    {"schema", [](A) { return std::to_string(servo_schema); }, always, kinds::one},
    {"run_id", nullptr, always},
    {"detector", [](A asked) { return asked.row.detector; }, always},
    {"options", [](A asked) { return asked.row.options; }, optional},
    {"mesh", [](A asked) { return asked.row.mesh; }, always},
    {"triangles", [](A asked) { return count(asked.row.triangles); }, always, kinds::whole_number},
    {"trajectory", [](A asked) { return asked.row.trajectory; }, always},
    {"query", [](A asked) { return question_of(asked.settings, asked.row.query); }, always, question_kind},
    {"steps", [](A asked) { return count(asked.row.steps); }, always, kinds::whole_number},
    {"radius", [](A asked) { return count(asked.row.radius); }, always, kinds::length},
    {"reach", [](A asked) { return count(asked.row.reach); }, always, kinds::length},
    {"rate_hz", [](A asked) { return count(asked.settings.rate_hz); }, always, kinds::positive},
    {"work_us", [](A asked) { return count(asked.settings.work_us); }, always, kinds::finite},
    {"load", [](A asked) { return std::string(name_of(asked.settings.load)); }, always, load_kind},
    {"guarantee", guarantee, optional, kinds::guarantee},
    {"missed", of_counts<&oracle::ErrorCounts::missed>, optional, kinds::whole_number},
    {"false_contacts", of_counts<&oracle::ErrorCounts::false_contacts>, optional, kinds::whole_number},
    {"wrong_triangle", of_counts<&oracle::ErrorCounts::wrong_triangle>, optional, kinds::whole_number},
    {"beyond_bound", of_counts<&oracle::ErrorCounts::beyond_bound>, optional, kinds::whole_number},
    {"status", [](A asked) { return asked.row.status; }, always},
    {"verdict", [](A asked) { return std::string(name_of(asked.row.verdict())); }, always, verdict_kind},
    {"ticks", of_tally<loop, &TickTally::ticks>, optional, kinds::whole_number},
    {"missed_ticks", of_tally<loop, &TickTally::missed>, optional, kinds::whole_number},
    {"lost_ticks", of_tally<loop, &TickTally::lost>, optional, kinds::whole_number},
    {"longest_miss_run", of_tally<loop, &TickTally::max_run>, optional, kinds::whole_number},
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
    {"work_mean", [](A asked) { return counted(asked.row.work_mean); }, optional, kinds::finite},
    {"work_max", [](A asked) { return asked.row.work_max ? count(*asked.row.work_max) : ""; }, optional,
     kinds::whole_number},
    {"query_ns_by_work_max", [](A asked) { return counted(asked.row.ns_by_work_max()); }, optional,
     kinds::finite},
    {"minor_faults", of_kernel<loop, &LoopResult::minor_faults>, optional, kinds::whole_number},
    {"major_faults", of_kernel<loop, &LoopResult::major_faults>, optional, kinds::whole_number},
    {"involuntary_switches", of_kernel<loop, &LoopResult::involuntary_switches>, optional,
     kinds::whole_number},
    {"idle_overrun", of_kernel<idle, &LoopResult::overrun>, optional, kinds::bit},
    {"turns_missed_more", [](A asked) { return count(asked.row.worse); }, always, kinds::whole_number},
    {"turns_idle_missed_more", [](A asked) { return count(asked.row.idle_worse); }, always,
     kinds::whole_number},
    {"idle_ticks", of_tally<idle, &TickTally::ticks>, optional, kinds::whole_number},
    {"idle_missed_ticks", of_tally<idle, &TickTally::missed>, optional, kinds::whole_number},
    {"idle_latency_ns_p50", percentile<idle, latency, 5000>, optional, kinds::whole_number},
    {"idle_latency_ns_p99", percentile<idle, latency, 9900>, optional, kinds::whole_number},
    {"idle_latency_ns_p999", percentile<idle, latency, 9990>, optional, kinds::whole_number},
    {"idle_latency_ns_p9999", percentile<idle, latency, 9999>, optional, kinds::whole_number},
    {"idle_latency_ns_max", percentile<idle, latency, 10'000>, optional, kinds::whole_number},
    {"idle_involuntary_switches", of_kernel<idle, &LoopResult::involuntary_switches>, optional,
     kinds::whole_number},
    {"proxy", [](A asked) { return asked.settings.proxy ? std::string(own_proxy) : ""; }, optional,
     method_kind},
    {"judged_ticks", of_proxy<&ProxyCounts::ticks>, optional, kinds::whole_number},
    {"crossings", of_proxy<&ProxyCounts::crossings>, optional, kinds::whole_number},
    {"violations", of_proxy<&ProxyCounts::violations>, optional, kinds::whole_number},
    {"contact_ticks", of_proxy<&ProxyCounts::contact_ticks>, optional, kinds::whole_number},
    {"stuck_ticks", of_proxy<&ProxyCounts::stuck_ticks>, optional, kinds::whole_number},
});

/// What ties rows of the three files.
std::vector<std::string> key_of(const ServoRow& row) {
  return {std::to_string(servo_schema), row.detector, row.options, row.trajectory};
}

void add_buckets(support::Table& table, const ServoRow& row, const char* loop_name, const char* time,
                 const measurement::LatencyHistogram& histogram) {
  for (const measurement::LatencyHistogram::Bucket& bucket : histogram.buckets()) {
    std::vector<std::string> fields = key_of(row);
    fields.insert(fields.end(), {loop_name, time, count(bucket.up_to_ns), count(bucket.ticks)});
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
                    {count(worst.tick), count(worst.step), count(probe.center.x()), count(probe.center.y()),
                     count(probe.center.z()), count(probe.radius), count(worst.latency_ns),
                     rounded(worst.query_ns), count(worst.work.cells), count(worst.work.spheres),
                     count(worst.work.boxes), count(worst.work.triangles), count(worst.work.exact_decisions),
                     row.repeat.empty() ? "" : row.repeat + count(worst.step)});
      table.add(std::move(fields));
    }
  }
  return table.csv();
}

}  // namespace touchmark::bench::experiments::servo
