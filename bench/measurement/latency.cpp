#include "bench/measurement/latency.h"

#include <algorithm>
#include <cmath>

namespace touchmark::bench::measurement {
namespace {

/// The least value that at least `fraction` of all are not above.
double percentile(const std::vector<double>& sorted, double fraction) {
  const double rank = std::ceil(fraction * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

/// Ranks that a quantile lies between, by the normal approximation of the binomial distribution.
QuantileBounds bounds(const std::vector<double>& sorted, double fraction) {
  constexpr double normal_95 = 1.96;
  const auto size = static_cast<double>(sorted.size());
  const double margin = normal_95 * std::sqrt(size * fraction * (1 - fraction));
  const auto at = [&](double rank) {
    return sorted[static_cast<std::size_t>(std::clamp(rank, 1.0, size)) - 1];
  };
  return {at(std::floor(size * fraction - margin)), at(std::ceil(size * fraction + margin) + 1)};
}

DeadlineMisses count_misses(std::span<const double> ns, const std::vector<workload::StepRange>& ranges,
                            double period_ns) {
  DeadlineMisses count;
  std::size_t step = 0;
  for (const workload::StepRange& range : ranges) {
    std::size_t run = 0;  // steps on both sides of a gap are no neighbours
    for (const std::size_t end = step + range.size(); step < end; ++step) {
      run = ns[step] > period_ns ? run + 1 : 0;
      count.misses += run > 0 ? 1 : 0;
      count.max_run = std::max(count.max_run, run);
    }
  }
  return count;
}

}  // namespace

LatencySummary summarize_latency(std::span<const double> ns, const std::vector<workload::StepRange>& ranges) {
  std::vector<double> sorted(ns.begin(), ns.end());
  std::ranges::sort(sorted);
  LatencySummary summary;
  summary.p50 = percentile(sorted, 0.5);
  summary.p90 = percentile(sorted, 0.9);
  summary.p99 = percentile(sorted, 0.99);
  summary.p999 = percentile(sorted, 0.999);
  summary.max = sorted.back();
  for (std::size_t i = 0; i < deadlines_hz.size(); ++i)
    summary.deadlines[i] = count_misses(ns, ranges, 1e9 / deadlines_hz[i]);
  summary.p999_bounds = bounds(sorted, 0.999);
  return summary;
}

ColdSummary summarize_cold(std::span<const double> ns) {
  std::vector<double> sorted(ns.begin(), ns.end());
  std::ranges::sort(sorted);
  return {sorted.size(), percentile(sorted, 0.5), percentile(sorted, 0.99), percentile(sorted, 0.999),
          sorted.back(), bounds(sorted, 0.5),     bounds(sorted, 0.99)};
}

std::vector<double> median_per_step(const std::vector<std::vector<double>>& passes) {
  std::vector<double> medians(passes.front().size());
  std::vector<double> one_step(passes.size());
  for (std::size_t step = 0; step < medians.size(); ++step) {
    for (std::size_t pass = 0; pass < passes.size(); ++pass) one_step[pass] = passes[pass][step];
    const auto middle = one_step.begin() + static_cast<std::ptrdiff_t>((passes.size() - 1) / 2);
    std::nth_element(one_step.begin(), middle, one_step.end());
    medians[step] = *middle;
  }
  return medians;
}

}  // namespace touchmark::bench::measurement
