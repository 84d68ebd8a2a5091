#include "bench/experiments/servo/servo_row.h"

namespace touchmark::bench::experiments::servo {

Misses ServoRow::misses() const {
  Misses misses;
  if (loop) misses.ticks = loop->tally.ticks(), misses.missed = loop->tally.missed();
  misses.worse = worse;
  misses.idle_worse = idle_worse;
  if (idle) misses.idle_ticks = idle->tally.ticks(), misses.idle_missed = idle->tally.missed();
  return misses;
}

Verdict ServoRow::verdict() const {
  if (violates_guarantee()) return Verdict::does_not_hold;
  if (status == "ok") return verdict_on(misses());
  return status == overrun && idle && idle->overrun ? Verdict::inconclusive : Verdict::does_not_hold;
}

std::optional<double> ServoRow::ns_by_work_max() const {
  if (!loop || !work_max) return std::nullopt;
  return loop->tally.ns_for_work(static_cast<double>(*work_max));
}

}  // namespace touchmark::bench::experiments::servo
