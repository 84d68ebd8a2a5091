#include "bench/experiments/servo/servo_report.h"

#include <fmt/format.h>

#include "bench/experiments/servo/servo_csv.h"
#include "bench/support/table.h"

namespace touchmark::bench::experiments::servo {
namespace {

/// Controllers give up after so many misses in a row (Franka's does).
constexpr std::uint64_t run_that_stops_a_robot = 20;

std::string us(std::int64_t ns) { return fmt::format("{:.4g}", static_cast<double>(ns) / 1e3); }

std::string percentile(const measurement::LatencyHistogram& histogram, double fraction,
                       std::uint64_t needed) {
  return histogram.count() < needed ? "" : us(histogram.percentile(fraction));
}

std::vector<std::string> cells_of(const std::string& name, const LoopResult& loop, bool with_query) {
  const TickTally& tally = loop.tally;
  std::vector<std::string> cells{name, fmt::format("{}", tally.ticks()), fmt::format("{}", tally.missed()),
                                 fmt::format("{}", tally.max_run())};
  const auto add = [&cells](const measurement::LatencyHistogram& times) {
    cells.insert(cells.end(), {percentile(times, 0.5, 1), percentile(times, 0.99, 1),
                               percentile(times, 0.999, ticks_for_p999), us(times.max_ns())});
  };
  add(tally.latency());
  if (with_query)
    add(tally.query());
  else
    cells.resize(cells.size() + 4);
  cells.push_back(fmt::format("{}", loop.minor_faults + loop.major_faults));
  cells.push_back(fmt::format("{}", loop.involuntary_switches));
  return cells;
}

std::string why(const ServoRow& row) {
  if (row.status != "ok") {
    if (row.status != overrun) return row.status;
    const bool idle_too = row.verdict() == Verdict::inconclusive;
    return fmt::format("the loop was ended, since it found no time to sleep{}",
                       idle_too ? "; nor does it with nothing asked" : "");
  }
  if (row.proxy && row.violates_guarantee())
    return fmt::format("{} of {} steps crossed the surface, and {} came nearer to it than the radius",
                       row.proxy->crossings, row.proxy->ticks, row.proxy->violations);
  if (row.violates_guarantee()) return "its answers are not as exact as claimed";
  const Misses misses = row.misses();
  if (misses.ticks == 0 || misses.idle_ticks == 0) return "nothing was measured";
  std::string text = fmt::format("{} misses in {} ticks: below {:.2g} at {:g} %", misses.missed, misses.ticks,
                                 max_miss_rate(misses.missed, misses.ticks), 100 * usual_confidence);
  if (misses.missed > 0) {
    text += fmt::format(", up to {} in a row", row.loop->tally.max_run());
    if (row.loop->tally.max_run() >= run_that_stops_a_robot) text += ", where some controllers stop";
  }
  if (misses.idle_missed > 0)
    text += fmt::format("; the machine itself missed {} of {} ticks with nothing asked", misses.idle_missed,
                        misses.idle_ticks);
  if (!row.proxy) return text;
  const ProxyCounts& proxy = *row.proxy;
  text += fmt::format("; none of {} steps crossed the surface or came nearer than the radius, {} in contact",
                      proxy.ticks, proxy.contact_ticks);
  if (proxy.stuck_ticks > 0) text += fmt::format(", {} stuck too near to it", proxy.stuck_ticks);
  if (proxy.max_work)
    text += fmt::format("; {} ended by --max-work {}", proxy.unfinished_ticks, *proxy.max_work);
  return text;
}

std::string by_work(const ServoRow& row) {
  const std::optional<double> ns = row.ns_by_work_max();
  if (!ns) return "";
  return fmt::format(
      "; its slowest {} took {} us, and the step of most work ({} looked at) takes {:.3g} us by its work",
      row.proxy ? "step" : "query", us(row.loop->tally.query().max_ns()), *row.work_max, *ns / 1e3);
}

std::string name_of(Verdict verdict, const ServoRow& row, double rate_hz) {
  return fmt::format("{} {} {:g} Hz", row.contestant(),
                     verdict == Verdict::holds           ? "holds"
                     : verdict == Verdict::does_not_hold ? "does not hold"
                                                         : "inconclusive at",
                     rate_hz);
}

}  // namespace

std::string circumstances(const ServoSettings& settings, const workload::Workload& workload, int core,
                          const std::vector<ServoRow>& rows, const RealTimeHost& host) {
  std::string text = fmt::format(
      "{}, {} ({}), {}, radius {}\n{} ticks at {:g} Hz on core {}, as many of the same loop idle in turns; "
      "load {}, {:g} us of other work a tick{}\n",
      workload.mesh_name, workload.trajectories.front(), workload::trace_text(workload, 0),
      question_of(settings, rows.front().query), workload::length_text(workload, workload.radius),
      settings.ticks, settings.rate_hz, core, servo::name_of(settings.load), settings.work_us,
      settings.evicts ? fmt::format("; a tick every {:g} ms, all caches emptied before it",
                                    1e3 * settings.slowdown() / settings.rate_hz)
                      : "");
  for (const ServoRow& row : rows) {
    if (row.scheduler.empty()) continue;
    text += fmt::format("{}; memory: {}\n", row.scheduler, row.memory);
    break;
  }
  for (const std::string& warning : warnings_about(host)) text += fmt::format("warning: {}\n", warning);
  return text;
}

std::string loop_table(const ServoSettings& settings, const std::vector<ServoRow>& rows) {
  const std::string asked = settings.proxy ? "step" : "query";
  support::Table table({"us", "ticks", "missed", "in a row", "late p50", "p99", "p99.9", "max",
                        asked + " p50", "p99", "p99.9", "max", "faults", "preempted"});
  for (const ServoRow& row : rows) {
    if (row.loop) table.add(cells_of(row.contestant(), *row.loop, true));
    if (row.idle) table.add(cells_of("  idle loop", *row.idle, false));
  }
  return fmt::format(
      "\nlate: from a tick's scheduled start to its answer; missed: later than {:g} us; {}: alone\n{}",
      1e6 / settings.rate_hz, asked, table.text());
}

std::string worst_ticks(const workload::Workload& workload, const std::vector<ServoRow>& rows) {
  std::string text;
  for (const ServoRow& row : rows) {
    if (!row.loop) continue;
    support::Table table(
        {"tick", "step", "x", "y", "z", "late us", "query us", "cells", "spheres", "boxes", "triangles"});
    for (const WorstTick& worst : row.loop->tally.worst()) {
      const Vec3& at = workload.traces.front()[worst.step].probe.center;
      table.add({fmt::format("{}", worst.tick), fmt::format("{}", worst.step), fmt::format("{:.6g}", at.x()),
                 fmt::format("{:.6g}", at.y()), fmt::format("{:.6g}", at.z()), us(worst.latency_ns),
                 fmt::format("{:.4g}", worst.query_ns / 1e3), fmt::format("{}", worst.work.cells),
                 fmt::format("{}", worst.work.spheres), fmt::format("{}", worst.work.boxes),
                 fmt::format("{}", worst.work.triangles)});
    }
    text += fmt::format("\nworst ticks of {}{}\n{}", row.contestant(),
                        row.repeat.empty() ? "" : ", each answered again by " + row.repeat + "STEP",
                        table.text());
  }
  return text;
}

Verdict verdict_on_all(const std::vector<ServoRow>& rows) {
  std::vector<Verdict> verdicts;
  for (const ServoRow& row : rows) verdicts.push_back(row.verdict());
  return verdict_on_all(verdicts);
}

std::string verdict_lines(const ServoSettings& settings, const std::vector<ServoRow>& rows) {
  std::string text = "\n";
  for (const ServoRow& row : rows)
    text += fmt::format("{}: {}{}\n", name_of(row.verdict(), row, settings.rate_hz), why(row), by_work(row));
  return text + fmt::format("{}\n", servo::name_of(verdict_on_all(rows)));
}

}  // namespace touchmark::bench::experiments::servo
