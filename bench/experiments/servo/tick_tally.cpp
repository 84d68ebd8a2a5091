#include "bench/experiments/servo/tick_tally.h"

#include <algorithm>
#include <cmath>

namespace touchmark::bench::experiments::servo {

void TickTally::add(std::span<const workers::TickRecord> stretch) {
  std::uint64_t run = 0;
  for (const workers::TickRecord& record : stretch) {
    const std::uint64_t tick = ticks();
    latency_.add(record.latency_ns);
    const bool missed = record.asked == 0 || static_cast<double>(record.latency_ns) > period_ns_;
    run = missed ? run + 1 : 0;
    missed_ += missed ? 1 : 0;
    max_run_ = std::max(max_run_, run);
    if (record.asked == 0) {
      ++lost_;
      continue;
    }
    query_.add(std::llround(static_cast<double>(record.query_ticks) * ns_per_tick_));
    work_max_ = std::max(work_max_, record.work.total());
    add_worst(record, tick);
  }
  const auto slow = static_cast<double>(query_.percentile(0.95));
  for (const workers::TickRecord& record : stretch) {
    const double ns = static_cast<double>(record.query_ticks) * ns_per_tick_;
    if (record.asked == 0 || ns > slow) continue;
    const auto work = static_cast<double>(record.work.total());
    ++n_;
    const double work_off = work - work_mean_;
    work_mean_ += work_off / n_;
    ns_mean_ += (ns - ns_mean_) / n_;
    work_squares_ += work_off * (work - work_mean_);
    products_ += work_off * (ns - ns_mean_);
  }
}

void TickTally::add_worst(const workers::TickRecord& record, std::uint64_t tick) {
  if (worst_.size() == worst_count && record.latency_ns <= worst_.back().latency_ns) return;
  const WorstTick one{tick, record.step, record.latency_ns,
                      static_cast<double>(record.query_ticks) * ns_per_tick_, record.work};
  const auto later = [](const WorstTick& a, const WorstTick& b) { return a.latency_ns > b.latency_ns; };
  worst_.insert(std::upper_bound(worst_.begin(), worst_.end(), one, later), one);
  if (worst_.size() > worst_count) worst_.pop_back();
}

std::optional<double> TickTally::ns_for_work(double work) const {
  if (!(work_squares_ > 0 && products_ > 0)) return std::nullopt;
  return ns_mean_ + products_ / work_squares_ * (work - work_mean_);
}

}  // namespace touchmark::bench::experiments::servo
