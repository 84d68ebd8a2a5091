/// A sphere or a capsule of a scene: all points so far from its axis, a point or a segment. It needs no
/// detector, since the axis is one triangle without area. docs/exactness.md, E31.
#pragma once

#include <cstdint>
#include <optional>

#include "core/detector.h"
#include "core/probe.h"
#include "core/scene/nearest_image.h"
#include "core/scene/scene_bodies.h"
#include "core/scene/seen_body.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// Throws SceneError for an axis that is not one triangle without area, and for a radius that is not within
/// 2^-120 to 2^200.
void expect_round(const TriangleMesh& axis, double radius);

/// Asked about one point, with the questions of BodyQuery. Everything named here outlives it.
class RoundBody {
 public:
  /// `shape` is round.
  template <class Shape>
  RoundBody(const Shape& shape, const PlacedBody& placed, std::uint32_t body, const Vec3& point) noexcept
      : RoundBody(*shape.mesh, shape.radius, placed, body, point) {}
  RoundBody(const TriangleMesh& axis, double radius, const PlacedBody& placed, std::uint32_t body,
            const Vec3& point) noexcept;

  bool touches(double radius, Work& work) const noexcept {
    return is_within(candidate_, point_, radius, work.exact_decisions);
  }
  void nearest(NearestImage& nearest, double limit, double /*ahead*/, Work& work) const noexcept {
    if (candidate_.distance.lower <= limit) nearest.consider(candidate_, work.exact_decisions);
  }
  double clearance() const noexcept { return candidate_.distance.lower; }
  template <class Visit>
  bool for_each_within(double reach, const Visit& visit) const noexcept {
    return candidate_.distance.lower <= reach && visit(candidate_);
  }
  /// The first touch on a finite way from the point, its fraction 0 where the probe may touch at the start;
  /// or nothing.
  std::optional<Impact> first_hit(const Sweep& sweep, Work& work) const noexcept;

 private:
  /// Is the point nearer to the axis than the surface is?
  bool starts_inside(Work& work) const noexcept;
  /// The part of the way after which a probe outside may touch, or nothing where it surely does not.
  std::optional<double> outside_hit(const Sweep& sweep, double radius) const noexcept;
  /// The part of the way after which a probe inside may touch, where it does.
  double inside_hit(const Sweep& sweep) const noexcept;
  /// Is the axis surely as near, or from inside as far, as the probe must come on its way?
  bool surely_touches(const Sweep& sweep, bool inside) const noexcept;
  /// The distance to the axis at a part of the way, as computed.
  double distance_along(const Sweep& sweep, double part) const noexcept;
  /// Bounds what it is off by, after so many roundings.
  double error_along(const Sweep& sweep, double roundings) const noexcept;

  const Vec3& point_;
  ImageCandidate candidate_;
  double error_;  ///< bounds what the axis is seen off by
};

}  // namespace touchmark
