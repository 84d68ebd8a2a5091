#include <algorithm>
#include <cmath>

#include "bench/oracle/answer_judge.h"

namespace touchmark::bench::oracle {

void AnswerJudge::sweep(const SweepGroundTruth& truth, const Sweep& sweep, const workload::Answer& answer,
                        ErrorCounts& counts) const {
  ++counts.judged;
  const bool found = answer.found != 0;
  if (found && (!well_formed(answer, reported_) || !(answer.fraction >= 0 && answer.fraction <= 1))) {
    ++counts.malformed;
    return;
  }
  if (!truth.defined) {
    if (found) ++counts.false_contacts;
    return;
  }
  if (accuracy_.decides_exactly) return exact_sweep(truth, sweep, answer, counts);
  const auto largest_difference = [&](const Vec3& p) {
    return (p - low_).cwiseAbs().cwiseMax((p - high_).cwiseAbs()).maxCoeff();
  };
  const Vec3 path = sweep.to - sweep.from;
  // from + fraction * path rounds thrice, there and here; the fraction is rounded too.
  const double position_error =
      12 * unit_roundoff *
      (path.cwiseAbs().maxCoeff() + sweep.from.cwiseAbs().maxCoeff() + sweep.to.cwiseAbs().maxCoeff());
  const double tolerance =
      allowed(std::max(largest_difference(sweep.from), largest_difference(sweep.to))) + position_error;
  if (found != truth.hit) {
    const bool excused =
        known_ && (found ? oracle_.segment_within(sweep.from, sweep.to, raised(sweep.radius + tolerance))
                         : !surely_touches(sweep.from, sweep.to, sweep.radius, tolerance));
    ++(excused ? counts.unresolved : found ? counts.false_contacts : counts.missed);
    if (!excused) return;
  }
  if (!found) return;
  const Vec3 position = answer.fraction <= 0   ? sweep.from
                        : answer.fraction >= 1 ? sweep.to
                                               : Vec3(sweep.from + answer.fraction * path);
  const GroundTruth there = oracle_.solve(position);
  if (answer.fraction > 0) note_distance_error(std::abs(there.high - sweep.radius), counts);
  if (!oracle_.within(there, position, raised(sweep.radius + tolerance))) {
    ++counts.false_contacts;
  } else if (answer.fraction > 0 && surely_touches(sweep.from, position, sweep.radius, tolerance)) {
    ++counts.missed;
  } else {
    const bool claims_exactness = answer.fraction > 0 && accuracy_.guarantee == Guarantee::exact;
    const double early = claims_exactness ? sweep_gap(sweep, answer) : 0;
    contact(there, position, answer, position_error + early, counts);
  }
}

/// By how much the distance told at a fraction may differ from the radius, for the triangle named; in a scene
/// the true one, too.
double AnswerJudge::sweep_gap(const Sweep& sweep, const workload::Answer& answer) const {
  double largest = 0;
  const auto [begin, end] = oracle_.named_by(answer);
  for (std::size_t i = begin; i < end; ++i)
    largest = std::max(largest, oracle_.largest_difference(sweep.from, static_cast<std::uint32_t>(i)));
  return max_path_error(largest, (sweep.to - sweep.from).cwiseAbs().maxCoeff());
}

/// Nothing is excused.
void AnswerJudge::exact_sweep(const SweepGroundTruth& truth, const Sweep& sweep,
                              const workload::Answer& answer, ErrorCounts& counts) const {
  const bool found = answer.found != 0, at_start = found && answer.fraction == 0;
  if (found != truth.hit) {
    ++(found ? counts.false_contacts : counts.missed);
    return;
  }
  if (!found) return;
  if (at_start != truth.touching_at_start) {
    ++(at_start ? counts.false_contacts : counts.missed);
    return;
  }
  const double early = at_start ? 0 : sweep_gap(sweep, answer);
  constexpr double first_of_all = std::numeric_limits<double>::denorm_min();  // there is none before it
  if (answer.fraction > first_of_all && oracle_.touches_before(sweep, answer.fraction)) {
    ++counts.missed;
    return;
  }
  if (!at_start && !oracle_.touches_soon_after(sweep, answer.fraction, raised(sweep.radius + early))) {
    ++counts.false_contacts;
    return;
  }
  const Vec3 position = at_start              ? sweep.from
                        : answer.fraction < 1 ? Vec3(sweep.from + answer.fraction * (sweep.to - sweep.from))
                                              : sweep.to;
  const GroundTruth there = oracle_.solve(position);
  if (!at_start) note_distance_error(std::abs(there.high - sweep.radius), counts);
  // The fields are judged at a position that is rounded.
  const double rounding =
      4 * unit_roundoff * (sweep.from.cwiseAbs().maxCoeff() + position.cwiseAbs().maxCoeff());
  contact(there, position, answer, at_start ? 0 : early + rounding, counts);
}

}  // namespace touchmark::bench::oracle
