#include "bench/oracle/moving_judge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Geometry>

#include "bench/oracle/answer_judge.h"

namespace touchmark::bench::oracle {
namespace {

using Real = long double;
using Point = Eigen::Matrix<Real, 3, 1>;
using Turn = Eigen::Matrix<Real, 3, 3>;

}  // namespace

bool BodyScrew::goes_to(const Pose& after) {
  if (after == before_) return false;
  after_ = after;
  const Eigen::AngleAxis<Real> turn(
      Turn(after.rotation.cast<Real>() * before_.rotation.cast<Real>().transpose()));
  const Point way = (after.translation - before_.translation).cast<Real>();
  // A turn below this bends no way that double knows.
  constexpr Real straight = 1e-12L;
  if (turn.angle() < straight) {
    shift_ = way.cast<double>();
    return true;
  }
  const Point axis = turn.axis(), along = way.dot(axis) * axis, across = way - along;
  const Point center = (across + axis.cross(across) / std::tan(turn.angle() / 2)) / 2;
  angle_ = static_cast<double>(turn.angle());
  axis_ = axis.cast<double>();
  through_ = (before_.translation.cast<Real>() + center).cast<double>();
  shift_ = along.cast<double>();
  return true;
}

Pose BodyScrew::at(double time) const {
  if (time == 1) return after_;
  const Turn turn = Eigen::AngleAxis<Real>(static_cast<Real>(time) * static_cast<Real>(angle_),
                                           axis_.cast<Real>().normalized())
                        .toRotationMatrix();
  const Point from = (before_.translation - through_).cast<Real>();
  return {
      (turn * before_.rotation.cast<Real>()).cast<double>(),
      (through_.cast<Real>() + turn * from + static_cast<Real>(time) * shift_.cast<Real>()).cast<double>()};
}

ErrorCounts judge_moving(SceneOracle& oracle, std::span<const BodyScrew> screws, const Sweep& sweep,
                         const workload::Answer& answer) {
  ErrorCounts counts{.judged = 1};
  const bool found = answer.found != 0;
  if (found && (!well_formed(answer, {}) || !(answer.fraction >= 0 && answer.fraction <= 1))) {
    counts.malformed = 1;
    return counts;
  }
  const Vec3 way = sweep.to - sweep.from;
  // The gap changes by no more than the probe moves as a body sees it, and that is most at an end.
  double speed = way.norm(),
         size = oracle.bounds().max.cwiseAbs().cwiseMax(oracle.bounds().min.cwiseAbs()).norm();
  for (const BodyScrew& screw : screws)
    speed =
        std::max({speed, (way - screw.velocity(sweep.from)).norm(), (way - screw.velocity(sweep.to)).norm()});
  size = std::max({size, sweep.from.norm(), sweep.to.norm(), speed});
  const double rounding = 1e-12 * size;
  const auto gap = [&](double time) {
    for (const BodyScrew& screw : screws) oracle.place(screw.body(), screw.at(time));
    const GroundTruth truth = oracle.solve(Vec3(sweep.from + time * way));
    return truth.defined ? truth.high - sweep.radius : std::numeric_limits<double>::infinity();
  };
  constexpr double early = 0x1p-19;
  // A ball that is met is entered. A point is not, so the place is found where it comes to the surface.
  const double shortest = sweep.radius > 0 ? 0x1p-12 : 1e-9, surely_before = 1e-3;
  const double until = found ? answer.fraction : 1;
  bool comes_near = false, touches = false;
  std::size_t steps_left = 100'000;  // what is still open then is unresolved
  for (double time = 0; time < until && !touches && steps_left > 0; --steps_left) {
    const double left = gap(time);
    const bool is_near = left <= std::max(shortest * speed, rounding);
    comes_near = comes_near || is_near;
    touches = left < -rounding || (is_near && sweep.radius == 0 && time < until - surely_before);
    time += speed > 0 ? std::max(left / speed, shortest) : 1;
  }
  const double there = gap(until);
  if (touches || (!found && there < -rounding)) {
    counts.missed = 1;
  } else if (found && there > early * speed + rounding) {
    counts.false_contacts = 1;
  } else if (comes_near || steps_left == 0) {
    counts.unresolved = found && steps_left > 0 ? 0 : 1;
  }
  if (found) counts.max_distance_error = std::abs(answer.distance - there - sweep.radius);
  for (const BodyScrew& screw : screws) oracle.place(screw.body(), screw.at(1));
  return counts;
}

}  // namespace touchmark::bench::oracle
