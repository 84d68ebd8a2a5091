/// A body that goes from one pose to another within a tick, along the screw between them, and how a probe
/// that goes straight meanwhile moves in its frame. docs/exactness.md, E33.
#pragma once

#include "core/probe.h"
#include "core/scene/body.h"
#include "core/scene/pose.h"

namespace touchmark {

/// A part of a tick, from 0 to 1.
struct TickPart {
  double begin = 0, end = 1;
};

class MovingBody {
 public:
  static constexpr double max_turn = 2;  ///< radians in a tick

  /// Throws PoseError for a pose that is not rigid, and for a turn above max_turn.
  MovingBody(const BodyId& body, const Pose& before, const Pose& after);

  const BodyId& body() const noexcept { return body_; }
  /// Returns the pose after this part of the tick, rounded.
  Pose at(double time) const noexcept;
  /// Returns where a point is at the end of the part of the tick that rests in the body's frame, rounded.
  Vec3 carried(const Vec3& point, const TickPart& part) const noexcept;
  /// Bounds how far the way of a point that is carried is off the straight line between its ends.
  double sagitta(const Vec3& point, const TickPart& part) const noexcept;

  /// Returns true if no point of the shape comes within the sweep's radius in any part of the tick, as far as
  /// the ball of `extent` about the body's origin tells.
  bool is_beyond(const Sweep& sweep, double extent) const noexcept;

  /// A straight way in the body's frame. The probe comes no nearer to the moving shape than a ball on this
  /// way comes to the shape at rest, but for `sagitta` and `rounding`.
  struct Chord {
    Vec3 from, to;
    double sagitta;
    double rounding;
  };
  /// Returns the chord between two fractions of the sweep, which takes this part of the tick. No point of the
  /// shape is farther than `extent` from the body's origin.
  Chord chord(const Sweep& sweep, const TickPart& part, double begin, double end,
              double extent) const noexcept;
  /// Returns how far the probe goes in the body's frame on the sweep, at most, rounded.
  double relative_way(const Sweep& sweep, const TickPart& part) const noexcept;

 private:
  Vec3 velocity(const Vec3& point) const noexcept {
    return turn_.cross(point - before_.translation) + shift_;
  }

  BodyId body_;
  Pose before_;
  Vec3 turn_ = Vec3::Zero();   ///< axis times angle
  Vec3 shift_ = Vec3::Zero();  ///< the velocity of the body's origin at the start, in a tick
  double turn_error_ = 0;   ///< bounds what `at` is off the motion, times the distance to the body's origin
  double shift_error_ = 0;  ///< what it is off anywhere, besides
};

}  // namespace touchmark
