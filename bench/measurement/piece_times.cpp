#include "bench/measurement/piece_times.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "bench/support/random.h"

namespace touchmark::bench::measurement {
namespace {

constexpr std::size_t resamples = 200;
constexpr auto beyond = static_cast<std::size_t>(0.025 * resamples);  // on either side

double low_quantile(std::vector<double>& values) {
  const double rank = std::ceil(PieceTimes::quantile * static_cast<double>(values.size()));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void draw_again(std::vector<std::size_t>& drawn, const std::vector<std::size_t>& from,
                support::Random& random) {
  drawn.clear();
  for (std::size_t i = 0; i < from.size(); ++i) drawn.push_back(from[random.below(from.size())]);
}

std::vector<std::size_t> counted_to(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace

PieceTimes::PieceTimes(std::vector<Piece> pieces, std::vector<Stratum> strata)
    : pieces_(std::move(pieces)), strata_(std::move(strata)), of_stratum_(strata_.size()) {
  for (std::size_t i = 0; i < pieces_.size(); ++i) of_stratum_[pieces_[i].stratum].push_back(i);
}

void PieceTimes::add_round(const std::vector<double>& ns) {
  assert(!ns.empty() && ns.size() % pieces_.size() == 0);
  rounds_.push_back(ns);
}

std::vector<double> PieceTimes::low_quantiles(const std::vector<std::size_t>& rounds) const {
  std::vector<double> result, values;
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    values.clear();
    for (const std::size_t round : rounds) {
      const std::vector<double>& ns = rounds_[round];
      for (std::size_t i = piece; i < ns.size(); i += pieces_.size()) values.push_back(ns[i]);
    }
    result.push_back(low_quantile(values));
  }
  return result;
}

std::vector<double> PieceTimes::means(const std::vector<double>& ns,
                                      const std::vector<std::size_t>& pieces) const {
  std::vector<double> sums(strata_.size()), steps(strata_.size());
  for (const std::size_t i : pieces) {
    sums[pieces_[i].stratum] += ns[i];
    steps[pieces_[i].stratum] += static_cast<double>(pieces_[i].steps);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = steps[i] > 0 ? sums[i] / steps[i] : 0;
  return sums;
}

double PieceTimes::total(const std::vector<double>& means) const {
  double sum = 0;
  for (std::size_t i = 0; i < strata_.size(); ++i) sum += strata_[i].weight * means[i];
  return sum;
}

UndisturbedTime PieceTimes::estimate(std::uint64_t seed) const {
  support::Random random(seed);
  const std::vector<std::size_t> all_rounds = counted_to(rounds_.size()),
                                 all_pieces = counted_to(pieces_.size());
  std::vector<double> found;
  std::vector<std::size_t> rounds, some;
  for (std::size_t i = 0; i < resamples; ++i) {
    draw_again(rounds, all_rounds, random);
    const std::vector<double> ns = low_quantiles(rounds);
    std::vector<double> of_strata = means(ns, all_pieces);
    for (std::size_t stratum = 0; stratum < strata_.size(); ++stratum) {
      if (!(strata_[stratum].untimed > 0) || of_stratum_[stratum].empty()) continue;
      draw_again(some, of_stratum_[stratum], random);
      const double drawn = means(ns, some)[stratum];
      of_strata[stratum] += std::sqrt(strata_[stratum].untimed) * (drawn - of_strata[stratum]);
    }
    found.push_back(total(of_strata));
  }
  std::ranges::sort(found);
  const double ns = total(means(low_quantiles(all_rounds), all_pieces));
  return {ns, std::min(ns, found[beyond]), std::max(ns, found[resamples - 1 - beyond])};
}

}  // namespace touchmark::bench::measurement
