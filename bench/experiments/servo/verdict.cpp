#include "bench/experiments/servo/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/support/names.h"

namespace touchmark::bench::experiments::servo {
namespace {

/// Only a detector that is surely slower is told so where the machine misses as well.
constexpr double surely = 0.01;
/// Terms that are smaller than this part of the sum change no digit of it.
constexpr double negligible = 1e-18;

double log_choose(double n, double k) {
  return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
}

/// P(X <= k) of the binomial distribution, for a share above k / n: its terms fall towards 0.
double chance_of_at_most(double k, double n, double share) {
  double term = std::exp(log_choose(n, k) + k * std::log(share) + (n - k) * std::log1p(-share));
  double sum = 0;
  for (double i = k; i >= 0 && term > negligible * sum; --i) {
    sum += term;
    term *= i * (1 - share) / ((n - i + 1) * share);
  }
  return sum;
}

}  // namespace

double max_miss_rate(std::uint64_t missed, std::uint64_t ticks, double confidence) {
  if (missed >= ticks) return 1;
  const auto k = static_cast<double>(missed), n = static_cast<double>(ticks);
  if (missed == 0) return -std::expm1(std::log1p(-confidence) / n);
  double low = k / n, high = 1;
  while (high - low > 1e-12 * high) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) break;
    (chance_of_at_most(k, n, middle) > 1 - confidence ? low : high) = middle;
  }
  return high;
}

double chance_of_as_many(const Misses& misses) {
  const auto worse = static_cast<double>(misses.worse), n = worse + static_cast<double>(misses.idle_worse);
  // As likely as so few of the other kind; terms are added up on the side where they fall.
  if (2 * worse >= n) return chance_of_at_most(n - worse, n, 0.5);
  return worse > 0 ? 1 - chance_of_at_most(worse - 1, n, 0.5) : 1;
}

constexpr std::array<support::Name<Verdict>, 3> verdict_names{{{Verdict::holds, "holds"},
                                                               {Verdict::inconclusive, "inconclusive"},
                                                               {Verdict::does_not_hold, "does not hold"}}};

std::string_view name_of(Verdict verdict) noexcept { return support::name_in(verdict_names, verdict); }

Verdict verdict_on(const Misses& misses) {
  if (misses.ticks == 0 || misses.idle_ticks == 0) return Verdict::inconclusive;
  if (misses.idle_missed == 0) return misses.missed == 0 ? Verdict::holds : Verdict::does_not_hold;
  return chance_of_as_many(misses) < surely ? Verdict::does_not_hold : Verdict::inconclusive;
}

Verdict verdict_on_all(const std::vector<Verdict>& verdicts) noexcept {
  if (verdicts.empty()) return Verdict::inconclusive;
  return *std::max_element(verdicts.begin(), verdicts.end());
}

}  // namespace touchmark::bench::experiments::servo
