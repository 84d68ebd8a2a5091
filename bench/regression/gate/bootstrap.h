/// The median of paired ratios, and how well it is known.
#pragma once

#include <cstdint>
#include <span>

namespace touchmark::bench::regression::gate {

struct RatioInterval {
  double ratio = 1;  ///< the median
  double low = 1;    ///< ends of the interval that holds the true one in 95 of 100 cases
  double high = 1;
};

/// exp of the median of `log_ratios`, of which there is at least one. The interval is the percentile
/// bootstrap's: the rounds drawn anew, with replacement, some thousand times (Efron & Tibshirani 1993, 13.3).
/// The same for the same numbers and seed.
RatioInterval median_ratio(std::span<const double> log_ratios, std::uint64_t seed);

}  // namespace touchmark::bench::regression::gate
