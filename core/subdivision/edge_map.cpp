#include "core/subdivision/edge_map.h"

#include <algorithm>
#include <numeric>

namespace touchmark {
namespace {

/// Turns counts in places 1.. into the first place of each.
void accumulate(std::vector<std::uint32_t>& counts) {
  std::partial_sum(counts.begin(), counts.end(), counts.begin());
}

}  // namespace

template <std::size_t N>
EdgeMap<N>::EdgeMap(std::span<const Face> faces, std::size_t vertices) {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  const auto sides = static_cast<std::uint32_t>(faces.size() * N);
  const auto start = [&](std::uint32_t side) { return faces[side / N][side % N]; };
  const auto end = [&](std::uint32_t side) { return faces[side / N][(side + 1) % N]; };
  const auto low = [&](std::uint32_t side) { return std::min(start(side), end(side)); };
  const auto high = [&](std::uint32_t side) { return std::max(start(side), end(side)); };

  // Bucket the sides by their lower vertex; within a bucket the few with the same higher vertex are one edge.
  std::vector<std::uint32_t> first_at(vertices + 1, 0);
  for (std::uint32_t side = 0; side < sides; ++side) ++first_at[low(side) + 1];
  accumulate(first_at);
  std::vector<std::uint32_t> bucket(sides);
  std::vector<std::uint32_t> cursor(first_at.begin(), first_at.end() - 1);
  for (std::uint32_t side = 0; side < sides; ++side) bucket[cursor[low(side)]++] = side;

  std::vector<std::uint32_t> leader(sides);  // the lowest side on the same edge
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto here = std::span(bucket).subspan(first_at[v], first_at[v + 1] - first_at[v]);
    std::sort(here.begin(), here.end(), [&](std::uint32_t i, std::uint32_t j) {
      return high(i) != high(j) ? high(i) < high(j) : i < j;
    });
    for (std::size_t k = 0; k < here.size(); ++k)
      leader[here[k]] = k > 0 && high(here[k - 1]) == high(here[k]) ? leader[here[k - 1]] : here[k];
  }

  edge_of_.assign(sides, none);
  for (std::uint32_t side = 0; side < sides; ++side) {
    if (leader[side] != side) {
      edge_of_[side] = edge_of_[leader[side]];
      continue;
    }
    edge_of_[side] = static_cast<std::uint32_t>(ends_.size());
    ends_.push_back({start(side), end(side)});
  }

  first_.assign(ends_.size() + 1, 0);
  for (const std::uint32_t edge : edge_of_) ++first_[edge + 1];
  accumulate(first_);
  sides_.resize(sides);
  cursor.assign(first_.begin(), first_.end() - 1);
  for (std::uint32_t side = 0; side < sides; ++side) sides_[cursor[edge_of_[side]]++] = side;
}

template class EdgeMap<3>;
template class EdgeMap<4>;

}  // namespace touchmark
