/// One body asked about a way: whether the probe touches it there is decided for the images of its stored
/// triangles; the fraction is never late, and early by a bound. docs/exactness.md, E30.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/scene/body_query.h"
#include "core/scene/posed_predicates.h"
#include "core/scene/scene_bodies.h"
#include "core/scene/seen_body.h"
#include "core/scene/shape.h"

namespace touchmark {

/// The contact of a probe that has gone this far on its way with the image. The position is not rounded
/// first.
Contact contact_on_way(const ImageCandidate& seen_from_start, const Sweep& sweep, double fraction) noexcept;

/// Does the way come within the radius of the image, which is seen from that point? By the rounded places of
/// its corners: nothing where rounding leaves it open.
std::optional<bool> comes_within_rounded(const ImageCandidate& image, const Vec3& seen_from,
                                         const Sweep& sweep, std::uint64_t& exact_decisions) noexcept;

/// A ball that holds all that can come within the radius of the way.
struct Around {
  Vec3 center;
  double reach;
};
Around around_way(const Sweep& sweep, double error) noexcept;
/// Returns the length of the way, rounded up.
double path_length(const Vec3& from, const Vec3& to) noexcept;

/// Everything named here outlives it. The sweep is finite, its radius at least 0.
template <AnswersSweep D>
class BodySweep {
 public:
  BodySweep(const Shape<D>& shape, const PlacedBody& placed, std::uint32_t body, const Sweep& sweep,
            typename D::Session& session) noexcept
      : shape_(shape),
        sweep_(sweep),
        session_(session),
        from_(shape, SeenBody(placed.pose, double{placed.rigid}, sweep.from), body, session),
        to_(placed.pose, double{placed.rigid}, sweep.to),
        placed_(placed),
        body_(body) {}

  /// The first touch, its fraction 0 where the probe may touch at the start; or nothing.
  std::optional<Impact> first_hit(LimitedWork& work) const noexcept {
    // Along the way the image of the point in the body's frame is off by no more than at an end.
    const SeenBody& farther = from_.seen().residue() > to_.residue() ? from_.seen() : to_;
    const Accuracy accuracy = shape_.detector->accuracy();
    const Aabb& bounds = shape_.mesh->bounds();
    const double error = std::max(distance_error(accuracy, bounds, from_.seen().center()),
                                  distance_error(accuracy, bounds, to_.center()));
    // A detector that decides exactly is off by nothing where it decides whether a sweep hits.
    const double of_sweep = accuracy.decides_exactly ? 0 : error;
    const Sweep wider = in_frame(farther.reach_in_frame(sweep_.radius, of_sweep));
    const std::optional<Impact> hit = shape_.detector->first_hit(wider, session_);
    if (!hit) return std::nullopt;
    // Of an image at the radius the distance in the frame is no less than this.
    const double inner = farther.surely_within(sweep_.radius, of_sweep);
    const SeenCorners corners(from_.seen());
    if (!(inner >= 0 && shape_.detector->first_hit(in_frame(inner), session_)) &&
        !comes_within(hit->contact.triangle, corners, error, work))
      return std::nullopt;
    return Impact{hit->fraction, contact(*hit, corners)};
  }

 private:
  Sweep in_frame(double radius) const noexcept { return {from_.seen().center(), to_.center(), radius}; }

  /// Returns true if the way comes within the radius of an image, or the work is at its limit. Begins with
  /// the triangles that the detector met: all near the way may be many.
  bool comes_within(TriangleId met, const SeenCorners& corners, double error,
                    LimitedWork& work) const noexcept {
    const auto [begin, end] = from_.triangles_of(met);
    for (std::uint32_t i = begin; i < end; ++i)
      if (may_meet(from_.seen_as(corners, i), sweep_.from, work)) return true;
    const Around around = around_way(sweep_, error);
    const SeenBody seen(placed_.pose, double{placed_.rigid}, around.center);
    const BodyQuery<D> query(shape_, seen, body_, session_);
    return query.for_each_within(around.reach, [&](const ImageCandidate& candidate) {
      return candidate.id != met && candidate.distance.lower <= around.reach &&
             may_meet(candidate, around.center, work);
    });
  }
  bool may_meet(const ImageCandidate& image, const Vec3& seen_from, LimitedWork& work) const noexcept {
    if (work.exceeds_limit()) return true;
    std::optional<bool> known = within_by_sides(image.posed, sweep_.from, sweep_.to, sweep_.radius);
    if (!known) known = comes_within_rounded(image, seen_from, sweep_, work.exact_decisions);
    if (known) return *known;
    ++work.exact_decisions;
    return path_within_exactly(image.posed, sweep_.from, sweep_.to, 1, sweep_.radius);
  }

  /// On the triangle that the detector names; of a polygon's the one that is nearest there.
  Contact contact(const Impact& hit, const SeenCorners& corners) const noexcept {
    std::optional<Contact> nearest;
    const auto [begin, end] = from_.triangles_of(hit.contact.triangle);
    for (std::uint32_t i = begin; i < end; ++i) {
      const Contact contact = contact_on_way(from_.candidate(corners, i), sweep_, hit.fraction);
      if (!nearest || contact.distance < nearest->distance) nearest = contact;
    }
    return *nearest;
  }

  const Shape<D>& shape_;
  const Sweep& sweep_;
  typename D::Session& session_;
  BodyQuery<D> from_;
  SeenBody to_;
  const PlacedBody& placed_;
  std::uint32_t body_;
};

}  // namespace touchmark
