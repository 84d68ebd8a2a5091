/// The convex hull of points, as half spaces.
#pragma once

#include <span>
#include <vector>

#include "core/probe.h"

namespace touchmark::bench::experiments::audit {

/// By Qhull (Barber, Dobkin & Huhdanpaa 1996). Empty where all points lie in a plane.
class ConvexHull {
 public:
  /// No point is farther than `error`, which is above 0, outside, and the hull lies as closely within that of
  /// the points: a point counts only where it adds more than that.
  ConvexHull(std::span<const Vec3> points, double error);

  bool empty() const noexcept { return planes_.empty(); }
  /// Returns the distance to the surface of a point inside. Below 0 outside, where the distance is at least
  /// minus this; minus infinity where the hull is empty.
  double depth(const Vec3& point) const noexcept;

 private:
  struct Plane {
    Vec3 normal;  ///< unit, outward
    double offset;
  };
  std::vector<Plane> planes_;
};

}  // namespace touchmark::bench::experiments::audit
