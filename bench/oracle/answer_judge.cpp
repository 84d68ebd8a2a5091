#include "bench/oracle/answer_judge.h"

#include <array>
#include <numbers>

#include <Eigen/Geometry>

#include "bench/oracle/exact/interval_distance.h"
#include "bench/oracle/float_limits.h"

namespace touchmark::bench::oracle {
namespace {

double ulp(double x) noexcept { return raised(x) - x; }

Vec3 vector(const double (&xyz)[3]) noexcept { return {xyz[0], xyz[1], xyz[2]}; }

double angle(const Vec3& a, const Vec3& b) noexcept { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

bool well_formed(const workload::Answer& answer, const Reported& reported) noexcept {
  const bool distance = std::isfinite(answer.distance) && answer.distance >= 0;
  return (!reported.distance || distance) && (!reported.point || vector(answer.point).allFinite()) &&
         (!reported.normal || vector(answer.normal).allFinite());
}

Verdict AnswerJudge::threshold(const GroundTruth& truth, const Vec3& center, double limit, bool found) const {
  if (found == oracle_.within(truth, center, limit)) return Verdict::right;
  if (!known_ || !truth.defined || accuracy_.decides_exactly) return Verdict::wrong;
  const double bound = allowed(truth.largest_difference);
  const bool excused = found ? oracle_.within(truth, center, raised(limit + bound))
                             : !oracle_.within(truth, center, lowered(limit - bound));
  return excused ? Verdict::unresolved : Verdict::wrong;
}

/// The triangles that carry the id and are nearest within the accuracy.
std::vector<GroundTruth> AnswerJudge::with_id(const GroundTruth& truth, const Vec3& center,
                                              const workload::Answer& answer, double position_error) const {
  const auto [begin, end] = oracle_.named_by(answer);
  std::vector<GroundTruth> found;
  for (std::size_t i = begin; i < end; ++i) {
    const auto triangle = static_cast<std::uint32_t>(i);
    if (triangle == truth.triangle) {
      found.push_back(truth);
      continue;
    }
    const double largest = std::max(truth.largest_difference, oracle_.largest_difference(center, triangle));
    if (oracle_.within(triangle, center, raised(truth.high + allowed_in_fields(largest) + position_error)))
      found.push_back(oracle_.solve(center, triangle));
  }
  return found;
}

/// All triangles that are nearest within the accuracy.
std::vector<GroundTruth> AnswerJudge::tied(const GroundTruth& truth, const Vec3& center,
                                           double position_error) const {
  std::vector<GroundTruth> found;
  const double limit = raised(truth.high + allowed_in_fields(truth.largest_difference) + position_error);
  for (const std::uint32_t triangle : oracle_.all_within(center, limit))
    found.push_back(oracle_.solve(center, triangle));
  return found;
}

void AnswerJudge::note_distance_error(double error, ErrorCounts& counts) const {
  counts.max_distance_error = std::max(counts.max_distance_error, error);
  const double of_diagonal = diagonal_ > 0 ? error / diagonal_ : 0;
  counts.max_distance_error_of_diagonal = std::max(counts.max_distance_error_of_diagonal, of_diagonal);
}

/// The fields of an answer that rightly reports a contact. `slack` is what the position itself may be off by.
void AnswerJudge::contact(const GroundTruth& truth, const Vec3& center, const workload::Answer& answer,
                          double position_error, ErrorCounts& counts) const {
  if (!std::isfinite(truth.high)) return;  // beyond all doubles: any answer is
  std::vector<GroundTruth> nearest;
  if (reported_.triangle && answer.triangle != no_triangle) {
    nearest = with_id(truth, center, answer, position_error);
    if (nearest.empty()) ++counts.wrong_triangle;
  } else {
    nearest = tied(truth, center, position_error);
  }
  if (nearest.empty()) nearest.push_back(truth);
  double largest = truth.largest_difference;
  for (const GroundTruth& one : nearest) largest = std::max(largest, one.largest_difference);
  const double bound = allowed_in_fields(largest) + position_error + ulp(truth.high);
  const double rounding_bound = kernel_relative_error * largest + position_error + ulp(truth.high);

  if (reported_.distance) {
    const double error = std::abs((answer.distance - truth.high) - truth.low);
    note_distance_error(error, counts);
    if (truth.high > kernel_relative_error * largest + position_error)
      counts.max_distance_error_ulp = std::max(counts.max_distance_error_ulp, error / ulp(truth.high));
    if (error > bound) ++counts.beyond_bound;
    if (error > rounding_bound) ++(error > tolerance_ ? counts.beyond_tolerance : counts.rounding);
  }
  if (reported_.point) {
    const Vec3 point = vector(answer.point);
    // A difference of coordinates, rounded to them.
    const double rounding =
        4 * unit_roundoff * std::max(point.cwiseAbs().maxCoeff(), center.cwiseAbs().maxCoeff());
    double off = infinity;
    for (const GroundTruth& one : nearest)
      off = std::min(off, oracle_.distance_bounds(point, one.triangle).lo);
    counts.max_point_error = std::max(counts.max_point_error, off);
    const double nearness = std::abs((center - point).stableNorm() - truth.high);
    if (off > bound + rounding || nearness > bound + rounding) ++counts.wrong_point;
  }
  if (reported_.normal) {
    const Vec3 normal = vector(answer.normal);
    constexpr double single_precision = 1e-5;  // of a unit vector computed in it, generously
    bool wrong = !(std::abs(normal.norm() - 1) <= single_precision);
    // Nearer than this the direction of even the best answer in double is noise of up to 0.06 degrees.
    if (truth.high > 1024 * (kernel_relative_error * largest + position_error)) {
      double least = infinity;
      for (const GroundTruth& one : nearest) least = std::min(least, angle(normal, one.direction));
      counts.max_normal_angle_deg = std::max(counts.max_normal_angle_deg, least * 180 / std::numbers::pi);
      // A point x of a convex set, |x| <= d + 2 bound, is within sqrt(4 d bound + 4 bound^2) of the nearest;
      // one that is only `bound` away from the set, that much farther.
      const double shift = bound + 2 * std::sqrt(bound * (truth.high + bound));
      wrong = wrong || least > 2 * shift / truth.high + 16 * unit_roundoff + single_precision;
    }
    if (wrong) ++counts.wrong_normal;
  }
}

void AnswerJudge::bracket(const GroundTruth& truth, const Vec3& center, const workload::Answer& answer,
                          ErrorCounts& counts) const {
  const auto [begin, end] = oracle_.named_by(answer);
  if (begin == end) {
    ++counts.wrong_triangle;
    return;
  }
  GroundTruth named = oracle_.solve(center, static_cast<std::uint32_t>(begin));
  for (std::size_t i = begin + 1; i < end; ++i) {
    const GroundTruth other = oracle_.solve(center, static_cast<std::uint32_t>(i));
    if (other.high < named.high) named = other;
  }
  const double rounding = allowed(named.largest_difference) + ulp(named.high);
  const double off = std::abs((answer.distance - named.high) - named.low);
  if (!(answer.fraction >= 0 && answer.fraction <= answer.distance) || off > rounding ||
      !oracle_.within(truth, center, raised(answer.distance + rounding)) ||
      oracle_.within(truth, center, lowered(answer.fraction - rounding)))
    ++counts.malformed;
  note_distance_error(std::abs((answer.distance - truth.high) - truth.low), counts);
}

void AnswerJudge::position(const GroundTruth& truth, workload::Query query, const Probe& probe, double reach,
                           const workload::Answer& answer, ErrorCounts& counts) const {
  ++counts.judged;
  const bool found = answer.found != 0;
  const bool has_fields = found && query == workload::Query::nearest;
  // Infinitely far away within an infinite reach: any answer is right.
  const bool beyond_doubles = truth.defined ? std::isinf(truth.high) : !probe.center.hasNaN();
  if (has_fields && !beyond_doubles && !well_formed(answer, reported_)) {
    ++counts.malformed;
    return;
  }
  if (has_fields && answer.unfinished != 0) {
    bracket(truth, probe.center, answer, counts);
    return;
  }
  const double limit = query == workload::Query::touches ? probe.radius : reach;
  if (!truth.defined && beyond_doubles && limit == infinity) return;
  switch (threshold(truth, probe.center, limit, found)) {
    case Verdict::wrong:
      ++(found ? counts.false_contacts : counts.missed);
      return;
    case Verdict::unresolved:
      ++counts.unresolved;
      break;
    case Verdict::right:
      break;
  }
  if (!has_fields) return;
  const std::uint64_t wrong_before = counts.wrong_triangle;
  contact(truth, probe.center, answer, 0, counts);
  if (counts.wrong_triangle == wrong_before && is_misnamed(truth, answer)) ++counts.wrong_triangle;
  if (is_wrong(answer.side, probe.center)) ++counts.wrong_side;
}

}  // namespace touchmark::bench::oracle
