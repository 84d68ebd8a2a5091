#include "bench/oracle/reference.h"

#include <algorithm>
#include <cmath>

namespace touchmark::bench::oracle {

std::optional<bool> within_by_digits(const GroundTruth& truth, double radius) noexcept {
  if (!truth.defined || !(radius >= 0)) return false;
  // Rounding to nearest is monotone, so only equality leaves a doubt, and then `low` tells; unless it is
  // itself below what it is accurate to, or the result too small for either to be.
  const bool normal = truth.high > 0x1p-900;
  if (normal && truth.high != radius) return truth.high < radius;
  if (normal && std::abs(truth.low) > 0x1p-90 * truth.high) return truth.low < 0;
  return std::nullopt;
}

SweepGroundTruth truth_of_sweep(const Reference& reference, const Sweep& sweep) {
  if (!sweep.from.allFinite() || !sweep.to.allFinite()) return {};
  const bool touching = reference.segment_within(sweep.from, sweep.from, sweep.radius);
  return {true, touching || reference.segment_within(sweep.from, sweep.to, sweep.radius), touching};
}

std::pair<std::size_t, std::size_t> positions_of(const TriangleMesh& mesh, TriangleId id) {
  const auto ids = mesh.ids();
  if (ids.empty())
    return {std::min<std::size_t>(id, mesh.size()), std::min(std::size_t{id} + 1, mesh.size())};
  const auto range = std::equal_range(ids.begin(), ids.end(), id);
  return {static_cast<std::size_t>(range.first - ids.begin()),
          static_cast<std::size_t>(range.second - ids.begin())};
}

}  // namespace touchmark::bench::oracle
