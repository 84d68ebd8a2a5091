/// Which of the measured candidates to take: a pure function of their numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/choose/candidate.h"

namespace touchmark::bench::experiments::choose {

struct Limits {
  double rate_hz = 1000;
  double share = 0.1;               ///< the part of a tick that a query may take
  std::optional<double> max_bytes;  ///< nothing: any number

  double budget_ns() const noexcept { return share * 1e9 / rate_hz; }
};

/// What is wrong with one candidate. The first that applies counts.
enum class Obstacle {
  none,
  failed,         ///< its status is not ok
  not_exact,      ///< It claims no exactness, so that nothing says which answers are right.
  wrong_answers,  ///< It claims exactness and errs.
  over_memory,
  over_share_warm,  ///< at 99.9 % of the queries in a tight loop
  over_share_cold,  ///< at 99 % of the queries with all caches emptied
};

Obstacle obstacle_to(const Candidate& candidate, const Limits& limits);

/// Returns why not: "over the share at p99.9"; empty where nothing is in the way.
std::string why_not(const Candidate& candidate, const Limits& limits);

/// Returns the candidates that hold, as places in the list, the best first. Each is the one that takes the
/// least time among those that are left, or one that is not told from it (measurement::resolution) and takes
/// less memory, or as much and less time to build.
std::vector<std::size_t> ranking(const std::vector<Candidate>& candidates, const Limits& limits);

/// Returns how often the usual time fits into the share: below 1 it does not.
double margin_usual(const QueryTimes& times, const Limits& limits) noexcept;
/// Returns the same of the worst time.
double margin_worst(const QueryTimes& times, const Limits& limits) noexcept;

}  // namespace touchmark::bench::experiments::choose
