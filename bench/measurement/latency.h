/// What the servo loop sees: how long single steps take, and how many come too late.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "bench/contestants/contestant.h"

namespace touchmark::bench::measurement {

/// The haptic convention is 1 kHz; texture needs 4 to 10 kHz (Choi & Tan 2004).
inline constexpr std::array<double, 3> deadlines_hz{1000, 4000, 10000};

struct DeadlineMisses {
  std::size_t misses = 0;   ///< steps that took longer than the period
  std::size_t max_run = 0;  ///< how many neighbouring steps missed it one after the other
};

/// Two of the samples, between which the true quantile lies with 95 % confidence.
struct QuantileBounds {
  double low = 0, high = 0;
};

struct LatencySummary {
  double p50 = 0, p90 = 0, p99 = 0, p999 = 0, max = 0;  ///< ns, nearest rank
  std::array<DeadlineMisses, deadlines_hz.size()> deadlines;
  QuantileBounds p999_bounds{};  ///< as if no step's time had to do with another's
};

/// Queries with emptied caches.
struct ColdSummary {
  std::size_t samples = 0;
  double p50 = 0, p99 = 0, p999 = 0, max = 0;  ///< ns, nearest rank
  QuantileBounds p50_bounds{}, p99_bounds{};
};

/// At least one sample.
ColdSummary summarize_cold(std::span<const double> ns);

/// `ns` holds the ranges' steps one after the other. At least one step.
LatencySummary summarize_latency(std::span<const double> ns, const std::vector<workload::StepRange>& ranges);

/// Returns each step's median over passes that timed the same steps, so that one interruption by the
/// operating system does not count as the detector's. All passes have the same length; at least one.
std::vector<double> median_per_step(const std::vector<std::vector<double>>& passes);

}  // namespace touchmark::bench::measurement
