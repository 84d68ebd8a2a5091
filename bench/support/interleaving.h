/// Turns round by round, so that whatever changes on the machine meets all alike; in random order within a
/// round.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

#include "bench/support/random.h"

namespace touchmark::bench::support {

struct Turn {
  std::size_t round = 0;
  std::size_t which = 0;  ///< who takes the turn, from 0
};

/// `turns`: how many there are in each round.
inline std::vector<Turn> interleaved(const std::vector<std::size_t>& turns, Random& random) {
  std::vector<Turn> all;
  for (std::size_t round = 0; round < turns.size(); ++round) {
    std::vector<std::size_t> order(turns[round]);
    std::iota(order.begin(), order.end(), std::size_t{0});
    random.shuffle(order);
    for (const std::size_t which : order) all.push_back({round, which});
  }
  return all;
}

}  // namespace touchmark::bench::support
