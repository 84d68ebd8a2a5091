#include "core/scene/moving/moving_body.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/float_limits.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/scene/seen_body.h"

namespace touchmark {
namespace {

/// sin(x) / x, (1 - cos(x)) / x^2 and (x - sin(x)) / x^3.
struct TurnSeries {
  double first = 1, second = 1, third = 1;

  /// Up to x^2 = 4 the terms left out are below 2^-67. Sums alone give the same bits on every machine.
  explicit TurnSeries(double squared) noexcept {
    for (int k = 26; k > 0; k -= 2) {
      first = 1 - squared / (k * (k + 1)) * first;
      second = 1 - squared / ((k + 1) * (k + 2)) * second;
      third = 1 - squared / ((k + 2) * (k + 3)) * third;
    }
    second /= 2;
    third /= 6;
  }
};

/// The rotation by |turn| about it (Rodrigues).
Eigen::Matrix3d rotation_by(const Vec3& turn, const TurnSeries& series) noexcept {
  Eigen::Matrix3d cross;
  cross << 0, -turn.z(), turn.y(), turn.z(), 0, -turn.x(), -turn.y(), turn.x(), 0;
  return Eigen::Matrix3d::Identity() + series.first * cross + series.second * (cross * cross);
}

/// How far a point goes whose velocity is `shift` at first and turns by `turn`.
Vec3 way_by(const Vec3& turn, const Vec3& shift, const TurnSeries& series) noexcept {
  const Vec3 across = turn.cross(shift);
  return shift + series.second * across + series.third * turn.cross(across);
}

/// The shift that makes this way of it.
Vec3 shift_for(const Vec3& turn, const Vec3& way) noexcept {
  const double squared = turn.squaredNorm();
  const TurnSeries series(squared);
  // The difference loses digits where the product that it is for is small.
  const double part = squared > 0 ? (1 - series.first / (2 * series.second)) / squared : 0;
  const Vec3 across = turn.cross(way);
  return way - 0.5 * across + part * turn.cross(across);
}

/// The axis times the angle, found by turning on by the sine of what is left of the angle.
Vec3 turn_of(const Eigen::Matrix3d& rotation) noexcept {
  Vec3 turn = Vec3::Zero();
  for (int k = 0; k < 8; ++k) {  // the rest falls with its third power
    const Eigen::Matrix3d rest = rotation * rotation_by(turn, TurnSeries(turn.squaredNorm())).transpose();
    turn += 0.5 * Vec3(rest(2, 1) - rest(1, 2), rest(0, 2) - rest(2, 0), rest(1, 0) - rest(0, 1));
  }
  return turn;
}

}  // namespace

MovingBody::MovingBody(const BodyId& body, const Pose& before, const Pose& after)
    : body_(body), before_(before) {
  const double rigid = expect_rigid(before);
  expect_rigid(after);
  if (before.rotation != after.rotation) {
    const Eigen::Matrix3d rotation = after.rotation * before.rotation.transpose();
    const double cosine = (rotation.trace() - 1) / 2;
    if (cosine < std::cos(max_turn))
      throw PoseError("body " + std::to_string(body.index) + " turns by " +
                      std::to_string(std::acos(std::max(cosine, -1.0))) + " in a tick, which is more than " +
                      std::to_string(max_turn));
    turn_ = turn_of(rotation);
  }
  shift_ = shift_for(turn_, after.translation - before.translation);
  const Pose end = at(1);
  // E33: both poses count once, the rounding of `at` twice.
  turn_error_ = 2 * rigid + 1.01 * (after.rotation - end.rotation).norm() + 256 * unit_roundoff;
  shift_error_ =
      1.01 * (after.translation - end.translation).norm() +
      unit_roundoff * (256 * shift_.norm() + 16 * (before.translation.norm() + after.translation.norm()));
}

Pose MovingBody::at(double time) const noexcept {
  const Vec3 turn = time * turn_, shift = time * shift_;
  const double squared = turn.squaredNorm();
  if (squared == 0) return {before_.rotation, before_.translation + shift};
  const TurnSeries series(squared);
  return {rotation_by(turn, series) * before_.rotation, before_.translation + way_by(turn, shift, series)};
}

bool MovingBody::is_beyond(const Sweep& sweep, double extent) const noexcept {
  // The origin goes at one speed, and no point of the shape leaves the ball about it.
  const double apart = (sweep.from - before_.translation).norm();
  const double nearer = (sweep.to - sweep.from).norm() + shift_.norm() + shift_error_ + turn_error_ * extent;
  const double rounding = 4 * unit_roundoff * (sweep.from.norm() + before_.translation.norm());
  return apart < infinity && apart > (nearer + extent + sweep.radius + rounding) * (1 + 0x1p-40);
}

Vec3 MovingBody::carried(const Vec3& point, const TickPart& part) const noexcept {
  return image(at(part.end), in_frame(at(part.begin), point));
}

double MovingBody::sagitta(const Vec3& point, const TickPart& part) const noexcept {
  // A carried point goes on with the same speed about the axis.
  const double length = part.end - part.begin;
  return turn_.norm() * velocity(point).norm() * length * length / 8 * (1 + 32 * unit_roundoff);
}

MovingBody::Chord MovingBody::chord(const Sweep& sweep, const TickPart& part, double begin, double end,
                                    double extent) const noexcept {
  const double length = part.end - part.begin;
  const Vec3 way = sweep.to - sweep.from;
  double bend = 0, bend_error = 0, rounding = 0;
  const auto seen = [&](double fraction) {
    const Vec3 place = position_at(sweep, fraction);
    const Pose pose = at(part.begin + fraction * length);
    const SeenBody body(pose, rigid_error(pose.rotation), place);
    const Vec3 speed = length * velocity(place), turn = length * turn_;
    bend = std::max(bend, turn.cross(speed - 2 * way).norm());
    const double size = length * (turn.norm() * (place - before_.translation).norm() + shift_.norm());
    bend_error = std::max(bend_error, 32 * unit_roundoff * turn.norm() * (size + way.norm()));
    const double farthest = std::max(extent, body.center().norm());
    rounding = std::max(rounding, body.residue() + turn_error_ * farthest + 4 * unit_roundoff * place.norm() +
                                      4 * unit_roundoff * (sweep.from.norm() + way.norm()));
    return body.center();
  };
  const Vec3 from = seen(begin), to = seen(end);
  return {from, to, bend * (end - begin) * (end - begin) / 8,
          (rounding + shift_error_ + bend_error) * (1 + 64 * unit_roundoff)};
}

double MovingBody::relative_way(const Sweep& sweep, const TickPart& part) const noexcept {
  const double length = part.end - part.begin;
  const Vec3 way = sweep.to - sweep.from;
  return std::max((way - length * velocity(sweep.from)).norm(), (way - length * velocity(sweep.to)).norm());
}

}  // namespace touchmark
