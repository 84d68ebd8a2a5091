#include "bench/oracle/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "bench/oracle/interval_distance.h"
#include "bench/oracle/parallel.h"
#include "core/geometry/sphere_triangle_sweep.h"

namespace touchmark::bench {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

double ulp(double x) noexcept { return std::nextafter(x, infinity) - x; }
double raised(double x) noexcept { return std::nextafter(x, infinity); }
double lowered(double x) noexcept { return std::nextafter(x, -infinity); }

Vec3 vector(const double (&xyz)[3]) noexcept { return {xyz[0], xyz[1], xyz[2]}; }

bool well_formed(const Answer& answer, const Reported& reported) noexcept {
  const bool distance = std::isfinite(answer.distance) && answer.distance >= 0;
  return (!reported.distance || distance) && (!reported.point || vector(answer.point).allFinite()) &&
         (!reported.normal || vector(answer.normal).allFinite());
}

double angle(const Vec3& a, const Vec3& b) noexcept { return std::atan2(a.cross(b).norm(), a.dot(b)); }

enum class Verdict { right, unresolved, wrong };

/// Charges answers about one oracle's mesh by one contestant's word.
class Judge {
 public:
  Judge(const Oracle& oracle, const Accuracy& accuracy, const Reported& reported)
      : oracle_(oracle),
        accuracy_(accuracy),
        reported_(reported),
        known_(std::isfinite(accuracy.relative) && std::isfinite(accuracy.absolute)) {
    const TriangleMesh& mesh = oracle.mesh();
    low_ = high_ = mesh.corner(0, 0);
    for (std::uint32_t i = 0; i < mesh.size(); ++i) {
      for (const Vec3& v : triangle_of(mesh, i)) {
        low_ = low_.cwiseMin(v);
        high_ = high_.cwiseMax(v);
      }
    }
    diagonal_ = (high_ - low_).norm();
    tolerance_ = std::isfinite(diagonal_) ? physical_tolerance * diagonal_ : 0;
  }

  void position(const Truth& truth, Query query, const Probe& probe, double reach, const Answer& answer,
                Tally& tally) const;
  void sweep(const SweepTruth& truth, const Sweep& sweep, const Answer& answer, Tally& tally) const;

 private:
  /// What a contestant may be off by; if it does not say, what double arithmetic cannot avoid.
  double allowed(double largest_difference) const noexcept {
    return known_ ? accuracy_.relative * largest_difference + accuracy_.absolute
                  : kernel_relative_error * largest_difference;
  }
  /// The same for the fields of an answer. Whoever declares nothing is not held to what others declare.
  double allowed_in_fields(double largest_difference) const noexcept {
    return known_ ? allowed(largest_difference) : std::max(allowed(largest_difference), tolerance_);
  }
  /// Does the way touch the mesh beyond all excuse? A radius below the tolerance leaves no depth to tell by,
  /// only that the way goes through.
  bool surely_touches(const Vec3& from, const Vec3& to, double radius, double tolerance) const {
    return oracle_.segment_within(from, to, lowered(radius - tolerance)) ||
           (radius >= 0 && radius <= tolerance && oracle_.surely_crosses(from, to, tolerance));
  }
  double sweep_gap(const Sweep& sweep, TriangleId id) const;
  void exact_sweep(const SweepTruth& truth, const Sweep& sweep, const Answer& answer, Tally& tally) const;
  Verdict threshold(const Truth& truth, const Vec3& center, double limit, bool found) const;
  void contact(const Truth& truth, const Vec3& center, const Answer& answer, double slack,
               Tally& tally) const;
  std::vector<Truth> with_id(const Truth& truth, const Vec3& center, TriangleId id, double slack) const;
  std::vector<Truth> tied(const Truth& truth, const Vec3& center, double slack) const;
  void note_distance_error(double error, Tally& tally) const;
  /// Does it name another than the first of the nearest, and claims not to?
  bool is_misnamed(const Truth& truth, const Answer& answer) const {
    if (!accuracy_.names_exactly || !reported_.triangle || !std::isfinite(truth.high)) return false;
    const auto ids = oracle_.mesh().ids();
    return answer.triangle != (ids.empty() ? truth.triangle : ids[truth.triangle]);
  }
  bool is_wrong(Side said, const Vec3& center) const {
    if (said == Side::unasked || said == Side::undecided) return false;
    const std::optional<Side> side = oracle_.side(center);
    return side && *side != said;
  }

  const Oracle& oracle_;
  const Accuracy& accuracy_;
  const Reported& reported_;
  bool known_;
  Vec3 low_, high_;
  double diagonal_ = 0;
  double tolerance_ = 0;  ///< physical_tolerance in mesh units; 0 where the diagonal is beyond doubles
};

Verdict Judge::threshold(const Truth& truth, const Vec3& center, double limit, bool found) const {
  if (found == oracle_.within(truth, center, limit)) return Verdict::right;
  if (!known_ || !truth.defined || accuracy_.decides_exactly) return Verdict::wrong;
  const double bound = allowed(truth.largest_difference);
  const bool excused = found ? oracle_.within(truth, center, raised(limit + bound))
                             : !oracle_.within(truth, center, lowered(limit - bound));
  return excused ? Verdict::unresolved : Verdict::wrong;
}

/// Where those that carry the id begin and end.
std::pair<std::size_t, std::size_t> places_of(const TriangleMesh& mesh, TriangleId id) {
  const auto ids = mesh.ids();
  if (ids.empty())
    return {std::min<std::size_t>(id, mesh.size()), std::min(std::size_t{id} + 1, mesh.size())};
  const auto range = std::equal_range(ids.begin(), ids.end(), id);
  return {static_cast<std::size_t>(range.first - ids.begin()),
          static_cast<std::size_t>(range.second - ids.begin())};
}

/// The triangles that carry the id and are nearest within the accuracy.
std::vector<Truth> Judge::with_id(const Truth& truth, const Vec3& center, TriangleId id, double slack) const {
  const TriangleMesh& mesh = oracle_.mesh();
  const auto [begin, end] = places_of(mesh, id);
  std::vector<Truth> found;
  for (std::size_t i = begin; i < end; ++i) {
    const auto triangle = static_cast<std::uint32_t>(i);
    if (triangle == truth.triangle) {
      found.push_back(truth);
      continue;
    }
    double largest = truth.largest_difference;
    for (const Vec3& v : triangle_of(mesh, triangle))
      largest = std::max(largest, (v - center).cwiseAbs().maxCoeff());
    if (oracle_.within(triangle, center, raised(truth.high + allowed_in_fields(largest) + slack)))
      found.push_back(oracle_.solve(center, triangle));
  }
  return found;
}

/// All triangles that are nearest within the accuracy.
std::vector<Truth> Judge::tied(const Truth& truth, const Vec3& center, double slack) const {
  std::vector<Truth> found;
  const double limit = raised(truth.high + allowed_in_fields(truth.largest_difference) + slack);
  for (const std::uint32_t triangle : oracle_.all_within(center, limit))
    found.push_back(oracle_.solve(center, triangle));
  return found;
}

void Judge::note_distance_error(double error, Tally& tally) const {
  tally.max_distance_error = std::max(tally.max_distance_error, error);
  const double of_diagonal = diagonal_ > 0 ? error / diagonal_ : 0;
  tally.max_distance_error_of_diagonal = std::max(tally.max_distance_error_of_diagonal, of_diagonal);
}

/// The fields of an answer that rightly reports a contact. `slack` is what the position itself may be off by.
void Judge::contact(const Truth& truth, const Vec3& center, const Answer& answer, double slack,
                    Tally& tally) const {
  if (!std::isfinite(truth.high)) return;  // beyond all doubles: any answer is
  std::vector<Truth> nearest;
  if (reported_.triangle && answer.triangle != no_triangle) {
    nearest = with_id(truth, center, answer.triangle, slack);
    if (nearest.empty()) ++tally.wrong_triangle;
  } else {
    nearest = tied(truth, center, slack);
  }
  if (nearest.empty()) nearest.push_back(truth);
  double largest = truth.largest_difference;
  for (const Truth& one : nearest) largest = std::max(largest, one.largest_difference);
  const double bound = allowed_in_fields(largest) + slack + ulp(truth.high);
  const double rounding_bound = kernel_relative_error * largest + slack + ulp(truth.high);

  if (reported_.distance) {
    const double error = std::abs((answer.distance - truth.high) - truth.low);
    note_distance_error(error, tally);
    if (truth.high > kernel_relative_error * largest + slack)
      tally.max_distance_error_ulp = std::max(tally.max_distance_error_ulp, error / ulp(truth.high));
    if (error > bound) ++tally.beyond_bound;
    if (error > rounding_bound) ++(error > tolerance_ ? tally.beyond_tolerance : tally.rounding);
  }
  if (reported_.point) {
    const Vec3 point = vector(answer.point);
    // A difference of coordinates, rounded to them.
    const double rounding =
        4 * unit_roundoff * std::max(point.cwiseAbs().maxCoeff(), center.cwiseAbs().maxCoeff());
    double off = infinity;
    for (const Truth& one : nearest)
      off = std::min(off, distance_interval(point, triangle_of(oracle_.mesh(), one.triangle)).lo);
    tally.max_point_error = std::max(tally.max_point_error, off);
    const double nearness = std::abs((center - point).stableNorm() - truth.high);
    if (off > bound + rounding || nearness > bound + rounding) ++tally.wrong_point;
  }
  if (reported_.normal) {
    const Vec3 normal = vector(answer.normal);
    constexpr double single_precision = 1e-5;  // of a unit vector computed in it, generously
    bool wrong = !(std::abs(normal.norm() - 1) <= single_precision);
    // Nearer than this the direction of even the best answer in double is noise of up to 0.06 degrees.
    if (truth.high > 1024 * (kernel_relative_error * largest + slack)) {
      double least = infinity;
      for (const Truth& one : nearest) least = std::min(least, angle(normal, one.direction));
      tally.max_normal_angle_deg = std::max(tally.max_normal_angle_deg, least * 180 / std::numbers::pi);
      // A point x of a convex set, |x| <= d + 2 bound, is within sqrt(4 d bound + 4 bound^2) of the nearest;
      // one that is only `bound` away from the set, that much farther.
      const double shift = bound + 2 * std::sqrt(bound * (truth.high + bound));
      wrong = wrong || least > 2 * shift / truth.high + 16 * unit_roundoff + single_precision;
    }
    if (wrong) ++tally.wrong_normal;
  }
}

void Judge::position(const Truth& truth, Query query, const Probe& probe, double reach, const Answer& answer,
                     Tally& tally) const {
  ++tally.judged;
  const bool found = answer.found != 0;
  const bool has_fields = found && query == Query::nearest;
  // Infinitely far away within an infinite reach: any answer is right.
  const bool beyond_doubles = truth.defined ? std::isinf(truth.high) : !probe.center.hasNaN();
  if (has_fields && !beyond_doubles && !well_formed(answer, reported_)) {
    ++tally.malformed;
    return;
  }
  const double limit = query == Query::touches ? probe.radius : reach;
  if (!truth.defined && beyond_doubles && limit == infinity) return;
  switch (threshold(truth, probe.center, limit, found)) {
    case Verdict::wrong:
      ++(found ? tally.false_contacts : tally.missed);
      return;
    case Verdict::unresolved:
      ++tally.unresolved;
      break;
    case Verdict::right:
      break;
  }
  if (!has_fields) return;
  const std::uint64_t wrong_before = tally.wrong_triangle;
  contact(truth, probe.center, answer, 0, tally);
  if (tally.wrong_triangle == wrong_before && is_misnamed(truth, answer)) ++tally.wrong_triangle;
  if (is_wrong(answer.side, probe.center)) ++tally.wrong_side;
}

void Judge::sweep(const SweepTruth& truth, const Sweep& sweep, const Answer& answer, Tally& tally) const {
  ++tally.judged;
  const bool found = answer.found != 0;
  if (found && (!well_formed(answer, reported_) || !(answer.fraction >= 0 && answer.fraction <= 1))) {
    ++tally.malformed;
    return;
  }
  if (!truth.defined) {
    if (found) ++tally.false_contacts;
    return;
  }
  if (accuracy_.decides_exactly) return exact_sweep(truth, sweep, answer, tally);
  const auto largest_difference = [&](const Vec3& p) {
    return (p - low_).cwiseAbs().cwiseMax((p - high_).cwiseAbs()).maxCoeff();
  };
  const Vec3 way = sweep.to - sweep.from;
  // from + fraction * way rounds thrice, there and here; the fraction is rounded too.
  const double slack =
      12 * unit_roundoff *
      (way.cwiseAbs().maxCoeff() + sweep.from.cwiseAbs().maxCoeff() + sweep.to.cwiseAbs().maxCoeff());
  const double tolerance =
      allowed(std::max(largest_difference(sweep.from), largest_difference(sweep.to))) + slack;
  if (found != truth.hit) {
    const bool excused =
        known_ && (found ? oracle_.segment_within(sweep.from, sweep.to, raised(sweep.radius + tolerance))
                         : !surely_touches(sweep.from, sweep.to, sweep.radius, tolerance));
    ++(excused ? tally.unresolved : found ? tally.false_contacts : tally.missed);
    if (!excused) return;
  }
  if (!found) return;
  const Vec3 position = answer.fraction <= 0   ? sweep.from
                        : answer.fraction >= 1 ? sweep.to
                                               : Vec3(sweep.from + answer.fraction * way);
  const Truth there = oracle_.solve(position);
  if (answer.fraction > 0) note_distance_error(std::abs(there.high - sweep.radius), tally);
  if (!oracle_.within(there, position, raised(sweep.radius + tolerance))) {
    ++tally.false_contacts;
  } else if (answer.fraction > 0 && surely_touches(sweep.from, position, sweep.radius, tolerance)) {
    ++tally.missed;
  } else {
    const bool claims_exactness = answer.fraction > 0 && accuracy_.guarantee == Guarantee::exact;
    const double early = claims_exactness ? sweep_gap(sweep, answer.triangle) : 0;
    contact(there, position, answer, slack + early, tally);
  }
}

/// By how much the distance at the fraction told may exceed the radius, of the triangle named.
double Judge::sweep_gap(const Sweep& sweep, TriangleId id) const {
  double largest = 0;
  const auto [begin, end] = places_of(oracle_.mesh(), id);
  for (std::size_t i = begin; i < end; ++i)
    for (const Vec3& v : triangle_of(oracle_.mesh(), static_cast<std::uint32_t>(i)))
      largest = std::max(largest, (sweep.from - v).cwiseAbs().maxCoeff());
  return max_early_gap(largest, (sweep.to - sweep.from).cwiseAbs().maxCoeff());
}

/// Nothing is excused.
void Judge::exact_sweep(const SweepTruth& truth, const Sweep& sweep, const Answer& answer,
                        Tally& tally) const {
  const bool found = answer.found != 0, at_start = found && answer.fraction == 0;
  if (found != truth.hit) {
    ++(found ? tally.false_contacts : tally.missed);
    return;
  }
  if (!found) return;
  if (at_start != truth.touching_at_start) {
    ++(at_start ? tally.false_contacts : tally.missed);
    return;
  }
  const double early = at_start ? 0 : sweep_gap(sweep, answer.triangle);
  constexpr double first_of_all = std::numeric_limits<double>::denorm_min();  // there is none before it
  if (answer.fraction > first_of_all && oracle_.touches_before(sweep, answer.fraction)) {
    ++tally.missed;
    return;
  }
  if (!at_start && !oracle_.within_on_way(sweep, answer.fraction, raised(sweep.radius + early))) {
    ++tally.false_contacts;
    return;
  }
  const Vec3 position = at_start              ? sweep.from
                        : answer.fraction < 1 ? Vec3(sweep.from + answer.fraction * (sweep.to - sweep.from))
                                              : sweep.to;
  const Truth there = oracle_.solve(position);
  if (!at_start) note_distance_error(std::abs(there.high - sweep.radius), tally);
  // The fields are judged at a position that is rounded.
  const double rounding =
      4 * unit_roundoff * (sweep.from.cwiseAbs().maxCoeff() + position.cwiseAbs().maxCoeff());
  contact(there, position, answer, at_start ? 0 : early + rounding, tally);
}

/// Adds up judge_one(i, tally) for i < size.
template <class JudgeOne>
Tally total(std::size_t size, unsigned threads, Charges* charges, const JudgeOne& judge_one) {
  Tally sum;
  std::mutex mutex;
  in_parallel(size, threads, [&](std::size_t begin, std::size_t end) {
    Tally piece;
    Charges of_piece;
    for (std::size_t i = begin; i < end; ++i) {
      Tally one;
      judge_one(i, one);
      if (one.charged()) of_piece.add(i, one);
      piece += one;
    }
    const std::lock_guard lock(mutex);
    sum += piece;
    if (charges != nullptr) charges->merge(of_piece);
  });
  return sum;
}

}  // namespace

Tally& Tally::operator+=(const Tally& other) noexcept {
  judged += other.judged;
  missed += other.missed;
  false_contacts += other.false_contacts;
  wrong_triangle += other.wrong_triangle;
  beyond_bound += other.beyond_bound;
  beyond_tolerance += other.beyond_tolerance;
  rounding += other.rounding;
  wrong_point += other.wrong_point;
  wrong_normal += other.wrong_normal;
  malformed += other.malformed;
  wrong_side += other.wrong_side;
  unresolved += other.unresolved;
  max_distance_error = std::max(max_distance_error, other.max_distance_error);
  max_distance_error_of_diagonal =
      std::max(max_distance_error_of_diagonal, other.max_distance_error_of_diagonal);
  max_distance_error_ulp = std::max(max_distance_error_ulp, other.max_distance_error_ulp);
  max_normal_angle_deg = std::max(max_normal_angle_deg, other.max_normal_angle_deg);
  max_point_error = std::max(max_point_error, other.max_point_error);
  return *this;
}

void Charges::merge(const Charges& others, std::size_t first_step) {
  for (const Charge& one : others.kept_) kept_.push_back({first_step + one.step, one.tally});
  std::sort(kept_.begin(), kept_.end(), [](const Charge& a, const Charge& b) { return a.step < b.step; });
  if (kept_.size() > most_) kept_.resize(most_);
}

bool keeps_its_word(const Tally& tally, const Accuracy& accuracy) noexcept {
  if (tally.malformed + tally.wrong_side > 0) return false;
  if (accuracy.guarantee == Guarantee::approximate) return true;
  if (tally.missed > 0) return false;
  if (accuracy.guarantee == Guarantee::conservative) return true;
  return tally.false_contacts + tally.wrong_triangle + tally.beyond_bound + tally.wrong_point +
             tally.wrong_normal ==
         0;
}

Tally judge(const Oracle& oracle, std::span<const Truth> truths, Query query, std::span<const Probe> probes,
            double reach, std::span<const Answer> answers, const Accuracy& accuracy, const Reported& reported,
            Charges* charges) {
  const Judge judge(oracle, accuracy, reported);
  return total(std::min({truths.size(), probes.size(), answers.size()}), oracle.threads(), charges,
               [&](std::size_t i, Tally& tally) {
                 judge.position(truths[i], query, probes[i], reach, answers[i], tally);
               });
}

Tally judge(const Oracle& oracle, std::span<const SweepTruth> truths, std::span<const Sweep> sweeps,
            std::span<const Answer> answers, const Accuracy& accuracy, const Reported& reported,
            Charges* charges) {
  Accuracy of_sweeps = accuracy;
  // max_early_gap, where the way's start is within M of the triangle and the way's coordinates within 2 M.
  const double least = accuracy.guarantee == Guarantee::exact ? max_early_gap(1, 2) : kernel_relative_error;
  of_sweeps.relative = std::max(accuracy.relative, least);
  const Judge judge(oracle, of_sweeps, reported);
  return total(std::min({truths.size(), sweeps.size(), answers.size()}), oracle.threads(), charges,
               [&](std::size_t i, Tally& tally) { judge.sweep(truths[i], sweeps[i], answers[i], tally); });
}

}  // namespace touchmark::bench
