/// What all ticks of one loop come to: how late they were, how long their queries took, and which were worst.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bench/measurement/histogram.h"
#include "bench/workers/timing/paced_replay.h"
#include "core/detector.h"

namespace touchmark::bench::experiments::servo {

/// A tick that was asked, and was late.
struct WorstTick {
  std::uint64_t tick = 0;  ///< counted without warm-ups
  std::size_t step = 0;    ///< the trace's
  std::int64_t latency_ns = 0;
  double query_ns = 0;
  Work work;
};

class TickTally {
 public:
  static constexpr std::size_t worst_count = 10;

  TickTally(double rate_hz, double ns_per_tick) : period_ns_(1e9 / rate_hz), ns_per_tick_(ns_per_tick) {}

  /// A stretch of neighbouring ticks. Stretches are no neighbours: a run of misses ends with its stretch.
  void add(std::span<const workers::TickRecord> stretch);

  std::uint64_t ticks() const noexcept { return latency_.count(); }
  /// Ticks whose answer came later than a period after their scheduled start, the lost ones among them.
  std::uint64_t missed() const noexcept { return missed_; }
  std::uint64_t lost() const noexcept { return lost_; }
  std::uint64_t max_run() const noexcept { return max_run_; }
  /// From the scheduled start; of a lost tick to the first answer after it.
  const measurement::LatencyHistogram& latency() const noexcept { return latency_; }
  /// The query alone, one reading of the clock included.
  const measurement::LatencyHistogram& query() const noexcept { return query_; }
  /// By latency, the worst first.
  const std::vector<WorstTick>& worst() const noexcept { return worst_; }
  std::uint64_t work_max() const noexcept { return work_max_; }

  /// Returns what a query of so much work takes by the line through query time against work, least squares
  /// over the ticks but the slowest twentieth, which something else slowed. Nothing where work does not vary,
  /// or more work does not take longer.
  std::optional<double> ns_for_work(double work) const;

 private:
  void add_worst(const workers::TickRecord& record, std::uint64_t tick);

  double period_ns_, ns_per_tick_;
  measurement::LatencyHistogram latency_, query_;
  std::uint64_t missed_ = 0, lost_ = 0, max_run_ = 0, work_max_ = 0;
  std::vector<WorstTick> worst_;
  double n_ = 0, work_mean_ = 0, ns_mean_ = 0, work_squares_ = 0, products_ = 0;  // of the line
};

}  // namespace touchmark::bench::experiments::servo
