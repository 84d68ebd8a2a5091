#include "bench/measurement/steadiness.h"

#include <utility>

namespace touchmark::bench::measurement {

std::optional<Control> control_of(const ResultRow& row, const ResultRow& control) {
  if (!row.throughput || !control.throughput) return std::nullopt;
  const UndisturbedTime &first = row.throughput->undisturbed, &second = control.throughput->undisturbed;
  return Control{row.contestant(), second.ns / first.ns, second.low / first.high, second.high / first.low};
}

Steadiness steadiness_of(const std::vector<ResultRow>& rows, std::optional<Control> control) {
  Steadiness steadiness{rows.front().mesh, rows.front().trajectory, rows.front().query, 0,
                        std::move(control)};
  double timed = 0;
  for (const ResultRow& row : rows) {
    if (!row.throughput) continue;
    steadiness.disturbed_share += row.throughput->disturbed_share;
    ++timed;
  }
  if (timed > 0) steadiness.disturbed_share /= timed;
  return steadiness;
}

const ResultRow* fastest_exact(const std::vector<ResultRow>& rows) {
  const ResultRow* best = nullptr;
  for (const ResultRow& row : rows) {
    const bool eligible = row.throughput && row.accuracy && row.accuracy->guarantee == Guarantee::exact &&
                          !row.violates_guarantee();
    if (!eligible) continue;
    if (best == nullptr || row.throughput->undisturbed.ns < best->throughput->undisturbed.ns) best = &row;
  }
  return best;
}

}  // namespace touchmark::bench::measurement
