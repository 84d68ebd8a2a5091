/// The bounding volume of a child: a sphere cut by a slab.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/probe.h"
#include "core/search/plane_filter.h"
#include "core/simd/lanes.h"

namespace touchmark::spheres {

/// In the tree's frame, in single precision: the points within `radius` of the axis through `center` along
/// `normal`, and within `half` of the centre along it.
struct BoundingCylinder {
  Eigen::Vector3f center;
  float radius;
  Eigen::Vector3f normal;  ///< unit, but for its rounding
  float half;
};

/// Four points.
struct Point4 {
  Lanes x, y, z;
};

/// Points of the tree's frame, rounded to single precision, four to a vector.
class PointList {
 public:
  void add(const Vec3& p) {
    if (size_ % 4 == 0) fours_.push_back(Point4{});
    Point4& last = fours_.back();
    // What is not filled yet repeats the point.
    for (std::size_t i = size_ % 4; i < 4; ++i) {
      last.x[i] = static_cast<float>(p.x());
      last.y[i] = static_cast<float>(p.y());
      last.z[i] = static_cast<float>(p.z());
    }
    ++size_;
  }
  void clear() noexcept {
    fours_.clear();
    size_ = 0;
  }

  const std::vector<Point4>& fours() const noexcept { return fours_; }
  std::size_t size() const noexcept { return size_; }

 private:
  std::vector<Point4> fours_;
  std::size_t size_ = 0;
};

/// Holds every point as it was before it was rounded, for certain. The slab lies across `mean_normal` (of any
/// length; where it is zero any slab is as good). The sphere is within a few per cent of the smallest. At
/// least one point; coordinates below 2.
BoundingCylinder bound_points(const PointList& points, const Vec3& mean_normal) noexcept;

}  // namespace touchmark::spheres
