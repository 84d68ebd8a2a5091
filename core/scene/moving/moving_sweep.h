/// One moving body asked about a way: never late, early by a bound. docs/exactness.md, E33.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/detector.h"
#include "core/float_limits.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/scene/body_query.h"
#include "core/scene/moving/moving_body.h"
#include "core/scene/round/round_body.h"
#include "core/scene/scene_bodies.h"
#include "core/scene/shape.h"

namespace touchmark {

/// Everything named here outlives it. The sweep is finite, its radius at least 0.
template <AnswersSweep D>
class MovingSweep {
 public:
  /// Asks about the sweep up to the fraction `limit`.
  MovingSweep(const MovingBody& moving, const Aabb& bounds, const Sweep& sweep, const TickPart& part,
              double limit) noexcept
      : moving_(moving),
        bounds_(bounds),
        extent_(extent_of(bounds)),
        sweep_(sweep),
        part_(part),
        limit_(limit),
        whole_(moving.chord(sweep, part, 0, limit, extent_)) {}

  /// Returns a length that no corner of the bounds exceeds.
  static double extent_of(const Aabb& bounds) noexcept {
    return bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs()).norm();
  }

  /// Returns true if the body's bounds are surely farther all the way.
  bool is_beyond_bounds() const noexcept {
    const Sweep in_frame = asked(whole_);
    const Vec3 middle = in_frame.from + 0.5 * (in_frame.to - in_frame.from);
    const double half = (in_frame.to - in_frame.from).norm() / 2;
    return std::sqrt(bounds_.squared_distance(middle)) > (in_frame.radius + half) * (1 + 0x1p-40);
  }

  /// Returns the first touch, or a place before where the gap is below the bound.
  std::optional<Impact> first_hit(const Shape<D>& shape, typename D::Session& session,
                                  LimitedWork& work) const noexcept {
    const double good = good_sagitta * moving_.relative_way(sweep_, part_);
    double begin = 0, length = limit_;
    while (begin < limit_) {
      const double end = std::min(begin + length, limit_);
      const MovingBody::Chord chord =
          begin == 0 && end == limit_ ? whole_ : moving_.chord(sweep_, part_, begin, end, extent_);
      const Sweep in_frame = asked(chord, shape.is_round() ? Accuracy() : shape.detector->accuracy());
      if (!(in_frame.radius < infinity)) return Impact{begin, {}};
      const std::optional<Impact> hit =
          shape.is_round() ? RoundBody(shape, PlacedBody(), 0, in_frame.from).first_hit(in_frame, work)
                           : shape.detector->first_hit(in_frame, session);
      if (!hit) {
        begin = end;
        length *= 2;
        continue;
      }
      const double at = (begin + hit->fraction * (end - begin)) * (1 - 8 * unit_roundoff);
      if (chord.sagitta <= good || end - begin <= shortest) return told(*hit, at);
      length = (end - begin) / 2;
      begin = std::max(begin, at);
    }
    return std::nullopt;
  }

 private:
  static constexpr double good_sagitta = 0x1p-20;  ///< as a part of the probe's way in the body's frame
  static constexpr double shortest = 0x1p-12;      ///< no shorter part of the sweep can need to be halved

  /// A detector that does not decide exactly may be off by its error.
  Sweep asked(const MovingBody::Chord& chord, const Accuracy& accuracy = {}) const noexcept {
    const double error = accuracy.decides_exactly ? 0
                                                  : std::max(distance_error(accuracy, bounds_, chord.from),
                                                             distance_error(accuracy, bounds_, chord.to));
    const double radius = sweep_.radius + chord.sagitta + chord.rounding + error;
    return {chord.from, chord.to, radius * (1 + 4 * unit_roundoff)};
  }
  /// The contact in the scene, where body and probe are then.
  Impact told(const Impact& hit, double fraction) const noexcept {
    const Pose pose = moving_.at(part_.begin + fraction * (part_.end - part_.begin));
    Contact contact = hit.contact;
    contact.point = image(pose, contact.point);
    contact.normal = (pose.rotation * contact.normal).normalized();
    contact.distance = (position_at(sweep_, fraction) - contact.point).norm();
    return {fraction, contact};
  }

  const MovingBody& moving_;
  const Aabb& bounds_;
  double extent_;
  const Sweep& sweep_;
  const TickPart& part_;
  double limit_;
  MovingBody::Chord whole_;
};

template <BodyDetector D>
std::optional<BodyImpact> Scene<D>::first_hit_moving(
    const Sweep& sweep, std::span<const MovingBody> moving, Session& session, const TickPart& part,
    const MovingBody* left_out) const noexcept requires AnswersSweep<D> {
  if (!(sweep.radius >= 0) || !sweep.from.allFinite() || !sweep.to.allFinite()) return std::nullopt;
  const auto moves = [&](std::uint32_t body) {
    return std::ranges::any_of(moving, [&](const MovingBody& m) { return m.body() == bodies_.id(body); });
  };
  FirstImpact first;
  if (!is_clear_of_all(sweep, session)) first = first_of_standing(sweep, moves, session);
  for (const MovingBody& body : moving) {
    if (&body == left_out || !bodies_.has(body.body())) continue;
    const std::uint32_t index = body.body().index;
    const PlacedBody& placed = bodies_[index];
    const Aabb& bounds = bodies_.bounds_of(placed);
    ++session.work.bodies;
    if (body.is_beyond(sweep, MovingSweep<D>::extent_of(bounds))) continue;
    const double limit = first.impact ? first.impact->fraction : 1;
    const MovingSweep<D> swept(body, bounds, sweep, part, limit);
    if (swept.is_beyond_bounds()) continue;
    ask(NearBodies::room + placed.shape % NearBodies::unlisted_room, index,
        bodies_.seen_from(index, sweep.from), session,
        [&](const Shape<D>& shape, std::uint32_t, const SeenBody&, typename D::Session& own) {
          const std::optional<Impact> hit = swept.first_hit(shape, own, session.work);
          if (hit) first.take(*hit, index);
          return unknown;
        });
  }
  if (session.work.undecided) return BodyImpact();
  return first.impact ? std::optional(BodyImpact{bodies_.id(first.body), *first.impact}) : std::nullopt;
}

}  // namespace touchmark
