#include "bench/regression/gate/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bench/support/median.h"
#include "bench/support/random.h"

namespace touchmark::bench::regression::gate {

RatioInterval median_ratio(std::span<const double> log_ratios, std::uint64_t seed) {
  constexpr std::size_t resamples = 4000;
  constexpr auto beyond = static_cast<std::size_t>(0.025 * resamples);  // on either side
  support::Random random(seed);
  std::vector<double> drawn(log_ratios.size()), medians;
  for (std::size_t i = 0; i < resamples; ++i) {
    for (double& value : drawn) value = log_ratios[random.below(log_ratios.size())];
    medians.push_back(support::median(drawn));
  }
  std::ranges::sort(medians);
  return {std::exp(support::median({log_ratios.begin(), log_ratios.end()})), std::exp(medians[beyond]),
          std::exp(medians[resamples - 1 - beyond])};
}

}  // namespace touchmark::bench::regression::gate
