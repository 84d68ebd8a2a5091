#include "bench/experiments/choose/candidate.h"

#include <algorithm>

namespace touchmark::bench::experiments::choose {
namespace {

/// An answer is counted under each of its errors, so that no sum of them is the number of wrong answers. This
/// one is at least that, and above 0 where there is any.
std::uint64_t wrong_answers(const oracle::ErrorCounts& counts) {
  if (!counts.charged()) return 0;
  return counts.missed + counts.false_contacts +
         std::max(counts.wrong_triangle, measurement::answers_off(counts));
}

QueryTimes times_on(const measurement::ResultRow& row) {
  QueryTimes times;
  times.warm_p999 = row.latency->p999;
  times.warm_max = row.latency->max;
  times.cold_p50 = row.cold->p50;
  times.cold_p99 = row.cold->samples >= measurement::samples_for_p99 ? row.cold->p99 : row.cold->max;
  times.cold_max = row.cold->max;
  times.cold_samples = row.cold->samples;
  times.motion = row.trajectory;
  return times;
}

QueryTimes worse_of(const QueryTimes& one, const QueryTimes& other) {
  return {std::max(one.warm_p999, other.warm_p999),
          std::max(one.warm_max, other.warm_max),
          std::max(one.cold_p50, other.cold_p50),
          std::max(one.cold_p99, other.cold_p99),
          std::max(one.cold_max, other.cold_max),
          std::min(one.cold_samples, other.cold_samples),
          other.usual() > one.usual() ? other.motion : one.motion};
}

template <class Number>
void raise(std::optional<Number>& largest, const std::optional<Number>& value) {
  if (value && (!largest || *value > *largest)) largest = value;
}

void add(Candidate& candidate, const measurement::ResultRow& row) {
  if (candidate.status == "ok") candidate.status = row.status;
  if (row.counts) {
    candidate.wrong += wrong_answers(*row.counts);
    candidate.judged += row.steps;
  }
  if (row.latency && row.cold) {
    const QueryTimes times = times_on(row);
    candidate.times = candidate.times ? worse_of(*candidate.times, times) : times;
  }
  raise(candidate.build_ms, row.build_ms);
  raise(candidate.bytes, row.bytes);
  raise(candidate.bytes, row.heap_bytes);
}

}  // namespace

std::vector<Candidate> candidates_of(const std::vector<std::vector<measurement::ResultRow>>& motions) {
  std::vector<Candidate> candidates;
  for (const std::vector<measurement::ResultRow>& rows : motions) {
    for (const measurement::ResultRow& row : rows) {
      auto candidate = std::ranges::find(candidates, row.contestant(), &Candidate::contestant);
      if (candidate == candidates.end()) {
        candidate = candidates.emplace(candidate);
        candidate->detector = row.detector;
        candidate->options = row.options;
        candidate->claims_exactness = row.claims_exactness();
      }
      add(*candidate, row);
    }
  }
  return candidates;
}

}  // namespace touchmark::bench::experiments::choose
