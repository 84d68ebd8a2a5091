/// One detector with its options as it was measured on all motions: what the decision goes by.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/measurement/result_row.h"

namespace touchmark::bench::experiments::choose {

/// Times of single queries in ns; each is that of the motion where it is largest.
struct QueryTimes {
  double warm_p999 = 0;  ///< below 1,000 steps the largest
  double warm_max = 0;
  double cold_p50 = 0;           ///< with all caches emptied, as what follows
  double cold_p99 = 0;           ///< below 100 samples the largest
  double cold_max = 0;           ///< the largest of the samples
  std::size_t cold_samples = 0;  ///< those of the motion with the fewest
  std::string motion;            ///< the one on which the larger of warm_p999 and cold_p99 is largest

  /// Returns what must fit into the share: the larger of the 99.9 % warm and the 99 % cold.
  double usual() const noexcept { return warm_p999 > cold_p99 ? warm_p999 : cold_p99; }
  double worst() const noexcept { return warm_max > cold_max ? warm_max : cold_max; }
};

/// Empty is what was not measured, because the contestant did not come so far.
struct Candidate {
  std::string detector;
  std::string options;            ///< as written out: "key=value,..."
  std::string status = "ok";      ///< the first of a motion that is another
  bool claims_exactness = false;  ///< Only such a one can be recommended.
  std::uint64_t wrong = 0;        ///< answers that the oracle charged, over all motions
  std::size_t judged = 0;         ///< answers
  std::optional<QueryTimes> times;
  std::optional<double> build_ms;
  std::optional<std::uint64_t> bytes;  ///< the structure's own count or the heap's growth, whichever is more

  std::string contestant() const { return options.empty() ? detector : detector + ":" + options; }
};

/// One for each contestant that has a row, in the order of the rows.
std::vector<Candidate> candidates_of(const std::vector<std::vector<measurement::ResultRow>>& motions);

}  // namespace touchmark::bench::experiments::choose
