/// Bounds in double of what poses do to points and triangles: they choose what is decided exactly.
#pragma once

#include <cstdint>

#include "bench/oracle/exact/interval_distance.h"
#include "bench/oracle/triangle.h"

namespace touchmark::bench::oracle {

/// A body as its shape's tree must be asked. With R its rotation and y what R takes to c - t exactly, the
/// distance from c to the image of x is |R (y - x)|, and R stretches nothing by more than `rigid`,
/// relatively.
struct Seen {
  std::uint32_t shape = 0;
  Pose pose;
  double rigid = 0;
  double radius = 0;  ///< a round body's, or 0
};

/// Bounds |singular value - 1| of a rotation: their squares are off 1 by at most the norm of R^T R - I, whose
/// entries are rounded a few times.
double rigidity(const Eigen::Matrix3d& r) noexcept;

/// The point as the body sees it, and how far it may be from y: what R^T R is off the identity by, and the
/// rounding of a difference and of three products and sums a coordinate.
struct LocalPoint {
  Vec3 point;
  double error;
};
LocalPoint local(const Seen& body, const Vec3& point) noexcept;

/// The image rounded, and how far its corners may be from the exact one's.
struct RoundedImage {
  Triangle corners;
  double error;
};
RoundedImage rounded(const PlacedTriangle& triangle) noexcept;

/// The true distance to the surface lies in these.
Interval bounds_of(const Vec3& point, const PlacedTriangle& triangle) noexcept;
Interval bounds_of(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle) noexcept;

}  // namespace touchmark::bench::oracle
