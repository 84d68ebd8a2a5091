#include "bench/experiments/choose/decision.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "bench/measurement/steadiness.h"

namespace touchmark::bench::experiments::choose {
namespace {

/// What decides between candidates whose times are not told apart.
std::tuple<std::uint64_t, double> cost_beside_time(const Candidate& candidate) {
  return {candidate.bytes.value_or(std::numeric_limits<std::uint64_t>::max()),
          candidate.build_ms.value_or(std::numeric_limits<double>::infinity())};
}

/// The place in `left` of the best of them.
std::size_t best_of(const std::vector<Candidate>& candidates, const std::vector<std::size_t>& left) {
  const auto time_of = [&](std::size_t i) { return candidates[i].times->usual(); };
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : left) least = std::min(least, time_of(i));
  std::optional<std::size_t> best;
  for (std::size_t place = 0; place < left.size(); ++place) {
    if (time_of(left[place]) > measurement::resolution * least) continue;
    if (!best || cost_beside_time(candidates[left[place]]) < cost_beside_time(candidates[left[*best]]))
      best = place;
  }
  return *best;
}

}  // namespace

Obstacle obstacle_to(const Candidate& candidate, const Limits& limits) {
  if (candidate.status != "ok") return Obstacle::failed;
  if (!candidate.claims_exactness) return Obstacle::not_exact;
  if (candidate.wrong > 0) return Obstacle::wrong_answers;
  if (candidate.judged == 0 || !candidate.times) return Obstacle::failed;
  if (limits.max_bytes && !(candidate.bytes && static_cast<double>(*candidate.bytes) <= *limits.max_bytes))
    return Obstacle::over_memory;
  if (!(candidate.times->warm_p999 <= limits.budget_ns())) return Obstacle::over_share_warm;
  if (!(candidate.times->cold_p99 <= limits.budget_ns())) return Obstacle::over_share_cold;
  return Obstacle::none;
}

std::string why_not(const Candidate& candidate, const Limits& limits) {
  switch (obstacle_to(candidate, limits)) {
    case Obstacle::none:
      return "";
    case Obstacle::failed:
      return candidate.status == "ok" ? "neither judged nor timed" : candidate.status;
    case Obstacle::not_exact:
      return "claims no exactness";
    case Obstacle::wrong_answers:
      return fmt::format("wrong answers: {}", candidate.wrong);
    case Obstacle::over_memory:
      return "over the memory";
    case Obstacle::over_share_warm:
      return "over the share at p99.9";
    case Obstacle::over_share_cold:
      break;
  }
  return "over the share at p99 with caches emptied";
}

std::vector<std::size_t> ranking(const std::vector<Candidate>& candidates, const Limits& limits) {
  std::vector<std::size_t> left, ranked;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (obstacle_to(candidates[i], limits) == Obstacle::none) left.push_back(i);
  while (!left.empty()) {
    const std::size_t best = best_of(candidates, left);
    ranked.push_back(left[best]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return ranked;
}

double margin_usual(const QueryTimes& times, const Limits& limits) noexcept {
  return limits.budget_ns() / times.usual();
}

double margin_worst(const QueryTimes& times, const Limits& limits) noexcept {
  return limits.budget_ns() / times.worst();
}

}  // namespace touchmark::bench::experiments::choose
