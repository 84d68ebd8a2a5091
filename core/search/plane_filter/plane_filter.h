/// A single-precision lower bound of the distance to a triangle, four triangles at a time: what is farther
/// than the best distance known need not meet the exact kernel.
///
/// A triangle is four planes: its face, and through each side the plane perpendicular to the face. Height and
/// excess beyond a side, less the pad `plane_error` for rounding, bound the distance from below:
/// docs/exactness.md, E10, and from above E11.
///
/// How to use it:
///   const FilterFrame frame = FilterFrame::around(mesh.bounds());
///   std::vector<TrianglePlanes> planes;              // one of planes_of(prepared[i], frame) a triangle
///   const FilterPoint point = frame.point(center);   // a finite one
///   const float limit = frame.limit(best_squared);   // mesh units squared; infinity passes everything
///   Lanes bounds = lower_bounds(planes[a], planes[b], planes[c], planes[d], point);
///   for (unsigned left = at_most(bounds, limit); left != 0; left &= left - 1)
///     ... lane std::countr_zero(left) needs squared_distance(prepared, center)
/// Whatever is left out has squared_distance() > best_squared, so no tie is lost either. Frame and filter
/// work for every finite mesh whose box FilterFrame::fits; beyond that, do without.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/aabb.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/simd/lanes.h"

namespace touchmark {

/// Lane 0 is the face, lanes 1 to 3 the sides, outwards; in the filter's frame. One cache line.
struct alignas(64) TrianglePlanes {
  Lanes x, y, z, offset;
};
static_assert(sizeof(TrianglePlanes) == 64);

/// The query point in the filter's frame, and what rounding may do to a plane's value there.
struct FilterPoint {
  float x, y, z;
  float plane_error;
};

/// Puts the middle of the mesh at 0 and its extent near 1, by a power of two, so that nothing overflows and
/// scaling rounds nothing.
class FilterFrame {
 public:
  FilterFrame() = default;
  /// `bounds` must fit.
  static FilterFrame around(const Aabb& bounds) noexcept;
  /// Is the box's extent far enough from the ends of the range of double that squares of differences neither
  /// overflow nor vanish? A box of zero extent does not fit.
  static bool fits(const Aabb& bounds) noexcept;

  /// From now on it serves a mesh of this box as well. False, and nothing changes, where the box is not about
  /// as large as the one the frame is around, or elsewhere.
  bool widen(const Aabb& bounds) noexcept;

  /// Is the point close enough for single precision (2^20 extents)? A NaN is not.
  bool covers(const Vec3& center) const noexcept {
    const Vec3 p = to_frame(center);
    return std::abs(p.x()) < 0x1p20 && std::abs(p.y()) < 0x1p20 && std::abs(p.z()) < 0x1p20;
  }
  /// A quicker test on the point in this frame. It says no to some that are covered.
  static bool covers(const FilterPoint& point) noexcept {
    return point.plane_error < static_cast<float>(0x1p20 * plane_error_per_unit);
  }
  FilterPoint point(const Vec3& center) const noexcept {
    const Vec3 p = to_frame(center);
    return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), plane_error(p)};
  }
  Vec3 to_frame(const Vec3& point) const noexcept { return scale_ * (point - origin_); }
  Aabb to_frame(const Aabb& box) const noexcept { return {to_frame(box.min), to_frame(box.max)}; }
  /// A point of this frame in the mesh's, rounded to the doubles there: far from 0 these are far apart, and
  /// what is measured at the result holds of the point only within from_frame_error.
  Vec3 from_frame(const Vec3& in_frame) const noexcept { return origin_ + in_frame * unit_; }
  /// Bounds in this frame how far a point whose coordinates are within `largest` of 0 is from where
  /// from_frame puts it: docs/exactness.md, E13.
  double from_frame_error(double largest) const noexcept {
    constexpr double u = std::numeric_limits<double>::epsilon() / 2;
    return 1.25 * u * (origin_.lpNorm<1>() * scale_ + 3 * largest);
  }
  /// What rounding may do to a plane's value at this point of the frame.
  float plane_error(const Vec3& in_frame) const noexcept {
    const double reach = std::abs(in_frame.x()) + std::abs(in_frame.y()) + std::abs(in_frame.z()) + radius_;
    return static_cast<float>(reach * plane_error_per_unit);
  }
  /// Returns at least the distance_error of certified_nearest.h, in mesh units, at the point of this
  /// plane_error, and is quicker: plane_error is 2^-21 of a length that exceeds every coordinate difference,
  /// and this is twice that error of it.
  double kernel_error(float plane_error) const noexcept {
    return static_cast<double>(plane_error) * 0x1p-23 * unit_;
  }
  /// A squared distance of the mesh's frame as a limit on lower bounds, rounded up.
  float limit(double squared_distance) const noexcept {
    const double limit = squared_distance * squared_scale_ * (1 + 0x1p-20) + 0x1p-120;
    return limit < most ? static_cast<float>(limit) : most;
  }
  /// A distance of the mesh's frame in this one, rounded down.
  float to_frame_rounded_down(double distance) const noexcept {
    return static_cast<float>(std::min(distance * scale_ * (1 - 0x1p-20), double{most}));
  }
  /// A distance of this frame in the mesh's, rounded up.
  double from_frame_rounded_up(float distance) const noexcept {
    return static_cast<double>(distance) * (1 + 0x1p-20) * unit_;
  }
  /// A lower bound as a squared distance of the mesh's frame, rounded down.
  double squared(float lower_bound) const noexcept {
    return static_cast<double>(lower_bound) * (1 - 0x1p-20) / squared_scale_;
  }
  const Vec3& origin() const noexcept { return origin_; }
  double scale() const noexcept { return scale_; }
  /// Returns this frame's unit of length in the mesh's: a power of two, as the scale is.
  double unit() const noexcept { return unit_; }
  /// Returns the radius of a ball around the frame's middle that holds the mesh, in the frame.
  double radius() const noexcept { return radius_; }

  /// Eight roundings of single precision: docs/exactness.md, E10.
  static constexpr double plane_error_per_unit = 8 * 0x1p-24;

 private:
  static constexpr float most = std::numeric_limits<float>::max();

  /// Returns the distance from the frame's origin to the farthest point of the box, in the frame.
  double radius_of(const Aabb& bounds) const noexcept;

  Vec3 origin_ = Vec3::Zero();
  double scale_ = 1;
  double unit_ = 1;
  double squared_scale_ = 1;
  double radius_ = 1;  ///< bound on |offset|: no vertex is farther from the origin, in the frame
};

/// A triangle without a normal (collinear corners) gets planes that bound nothing: it always meets the
/// kernel.
TrianglePlanes planes_of(const PreparedTriangle& triangle, const FilterFrame& frame) noexcept;

/// A point in every lane, for loops over many triangles.
struct PointLanes {
  Lanes x, y, z, plane_error;

  explicit PointLanes(const FilterPoint& p) noexcept
      : x(broadcast(p.x)), y(broadcast(p.y)), z(broadcast(p.z)), plane_error(broadcast(p.plane_error)) {}
};

/// Values of one triangle's planes.
inline Lanes plane_values(const TrianglePlanes& planes, const PointLanes& p) noexcept {
  return ((planes.x * p.x + planes.y * p.y) + planes.z * p.z) + planes.offset;
}
inline Lanes plane_values(const TrianglePlanes& planes, const FilterPoint& p) noexcept {
  return plane_values(planes, PointLanes(p));
}

/// How far the point is beyond the side that it is farthest beyond; negative inside the prism over the face.
inline float max_side_excess(Lanes values) noexcept {
  return std::max(values[1], std::max(values[2], values[3]));
}

/// A lower bound of the squared distance to the triangle of these values, in the frame.
inline float squared_lower_bound(Lanes values, const FilterPoint& p) noexcept {
  const float side_excess = max_side_excess(values);
  const float height = std::max(std::abs(values[0]) - p.plane_error, 0.0F),
              excess = std::max(side_excess - p.plane_error, 0.0F);
  return height * height + excess * excess;
}

/// Bounds from above use the corners where two sides meet at a cosine between this and 0, with a pad in
/// plane_errors and a factor for rounding: docs/exactness.md, E11.
inline constexpr float sharpest_cosine = -63.0F / 64;
inline constexpr float corner_pad = 16, corner_excess = 1 + 0x1p-12F;

/// Returns at least the distance to the triangle, in the frame, where it is known: the values are those of
/// its planes, and the point is surely over its face, or it has a corner that is not too sharp. Else
/// infinity.
inline float distance_upper_bound(const TrianglePlanes& planes, Lanes values, const FilterPoint& p) noexcept {
  constexpr float unknown = std::numeric_limits<float>::infinity();
  const auto next = [](Lanes of) { return __builtin_shufflevector(of, of, 0, 2, 3, 1); };
  const Lanes cosine = planes.x * next(planes.x) + planes.y * next(planes.y) + planes.z * next(planes.z);
  const Lanes t = next(values);
  const Lanes squared =
      ((values * values + t * t) - (cosine + cosine) * (values * t)) / (1 - cosine * cosine);
  const LaneBits is_known = (cosine < 0) & (cosine > sharpest_cosine);
  const Lanes to_corner = is_known ? squared : broadcast(unknown);
  const float side_excess = max_side_excess(values);
  const float across = std::min(to_corner[1], std::min(to_corner[2], to_corner[3])) * corner_excess;
  const float height = std::abs(values[0]);
  if (side_excess <= -p.plane_error) return height + 2 * p.plane_error;
  return std::sqrt(height * height + across) + corner_pad * p.plane_error;
}

/// The position of a point relative to four triangles, a lane each: its distance to the face's plane, and how
/// far it is beyond the side it is farthest beyond; negative inside the prism over the face. Both are within
/// plane_error.
struct PlaneLanes {
  Lanes height, side_excess;
};

inline PlaneLanes plane_lanes(const TrianglePlanes& a, const TrianglePlanes& b, const TrianglePlanes& c,
                              const TrianglePlanes& d, const PointLanes& p) noexcept {
  // From four planes of one triangle to one plane of four triangles.
  const auto [face, side1, side2, side3] =
      simd::columns(plane_values(a, p), plane_values(b, p), plane_values(c, p), plane_values(d, p));
  return {simd::max(face, -face), simd::max(side1, simd::max(side2, side3))};
}

/// Lower bounds of the squared distances, in the frame.
inline Lanes lower_bounds(const PlaneLanes& values, const PointLanes& p) noexcept {
  const Lanes zero = {0, 0, 0, 0};
  const Lanes height = simd::max(values.height - p.plane_error, zero),
              excess = simd::max(values.side_excess - p.plane_error, zero);
  return height * height + excess * excess;
}
inline Lanes lower_bounds(const TrianglePlanes& a, const TrianglePlanes& b, const TrianglePlanes& c,
                          const TrianglePlanes& d, const PointLanes& p) noexcept {
  return lower_bounds(plane_lanes(a, b, c, d, p), p);
}
inline Lanes lower_bounds(const TrianglePlanes& a, const TrianglePlanes& b, const TrianglePlanes& c,
                          const TrianglePlanes& d, const FilterPoint& p) noexcept {
  return lower_bounds(a, b, c, d, PointLanes(p));
}

}  // namespace touchmark
