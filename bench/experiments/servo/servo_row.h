/// What one contestant did in the paced loop: a row of servo.csv and of the printed table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "bench/experiments/servo/load.h"
#include "bench/experiments/servo/tick_tally.h"
#include "bench/experiments/servo/verdict.h"
#include "bench/oracle/error_counts.h"
#include "bench/workload/answer.h"
#include "core/detector.h"
#include "core/haptics/coupling.h"

namespace touchmark::bench::experiments::servo {

/// The status of a row whose loop, or idle loop, was ended.
inline constexpr const char* overrun = "overrun";

struct ServoSettings {
  double rate_hz = 1000;
  std::uint64_t ticks = 10'000;  ///< each contestant's; its idle loop has as many more
  double work_us = 0;            ///< other work a tick on the same core
  Load load = Load::none;
  bool evicts = false;  ///< All caches are emptied before each tick, and ticks come slower, by `slowdown`.
  std::uint64_t seed = 1;
  std::optional<Coupling> proxy = {};  ///< steps our proxy in place of the query

  /// Emptying the caches takes longer than a period of a millisecond.
  unsigned slowdown() const noexcept { return evicts ? 20 : 1; }
};

/// What the oracle found in the ways of a proxy. All ticks that stepped it are judged, warm-ups among them.
struct ProxyCounts {
  std::uint64_t ticks = 0;
  std::uint64_t crossings = 0, violations = 0;  ///< ticks that met a triangle, or came nearer than the radius
  std::uint64_t contact_ticks = 0, stuck_ticks = 0;
  std::optional<std::uint64_t> max_work;  ///< what a step was bounded by, if by anything
  std::uint64_t unfinished_ticks = 0;     ///< those that it ended
};

/// A loop's ticks and what the kernel counted meanwhile.
struct LoopResult {
  TickTally tally;
  std::uint64_t minor_faults = 0, major_faults = 0, involuntary_switches = 0;
  bool overrun = false;  ///< it was ended, since it found no time to sleep
};

/// Empty is what was not measured, because the contestant did not come so far.
struct ServoRow {
  std::string detector;
  std::string options;  ///< as written out: "key=value,..."
  std::string mesh;
  std::size_t triangles = 0;
  std::string trajectory;
  workload::Query query = workload::Query::nearest;
  std::size_t steps = 0;  ///< the trajectory's
  double radius = 0;      ///< mesh units
  double reach = 0;       ///< mesh units
  std::string status =
      "ok";  ///< else unsupported, refused: ..., crashed:..., timeout, overrun, checksum mismatch

  std::optional<Accuracy> accuracy;           ///< as claimed
  std::optional<oracle::ErrorCounts> counts;  ///< as found
  std::optional<ProxyCounts> proxy;           ///< A proxy has these, and no answers.
  std::optional<double> work_mean;            ///< looked at, a step of the trajectory
  std::optional<std::uint64_t> work_max;
  std::optional<LoopResult> loop, idle;
  std::uint64_t worse = 0, idle_worse = 0;  ///< see Misses
  std::string scheduler, memory;            ///< what the system allowed
  std::string repeat;  ///< the command that prints the answer to a step, up to the step's number

  std::string contestant() const { return options.empty() ? detector : detector + ":" + options; }
  bool violates_guarantee() const {
    if (proxy) return proxy->crossings + proxy->violations > 0;
    return accuracy && counts && !oracle::meets_guarantee(*counts, *accuracy);
  }
  Misses misses() const;
  /// One that failed, or whose answers are wrong, does not hold the rate; nor one whose loop was ended,
  /// unless the idle loop was as well.
  Verdict verdict() const;
  /// Returns what the step of most work would take by its work; see TickTally::ns_for_work.
  std::optional<double> ns_by_work_max() const;
};

}  // namespace touchmark::bench::experiments::servo
