/// The bounding volume of a child: a cylinder across its triangles where they are as flat as a coin, and
/// along them where they are long.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/probe.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/simd/lanes.h"

namespace touchmark::bvh {

/// A cylinder in the tree's frame, in single precision: the points within `radius` of the axis through
/// `center` along `normal`, and within `half` of the centre along it. It began as a sphere cut by a slab
/// (Larsson and Akenine-Moeller, "Bounding volume hierarchies of slab cut balls", Computer Graphics Forum
/// 28(8), 2009); the radius is now measured across the axis.
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

/// Which ways the triangles at some points face, in the tree's frame. Normals are twice a triangle's area
/// long.
struct Facing {
  Vec3 sum = Vec3::Zero();      ///< the sum of all normals: along the mean one
  Vec3 largest = Vec3::Zero();  ///< the normal of the largest triangle

  void add(const Vec3& normal) noexcept {
    if (normal.squaredNorm() > largest.squaredNorm()) largest = normal;
    sum += normal;
  }
};

/// Returns a cylinder that certainly holds every point as it was before it was rounded. Its axis runs through
/// nearly the centre of the smallest sphere, along the mean normal. Where the triangles fill little of that,
/// as they do if they are long, or face both ways as those of a thin plate, it may run along the normal of
/// the largest one or between the points farthest apart, whichever gives the smaller volume. There must be at
/// least one point; coordinates are below 2.
BoundingCylinder bound_points(const PointList& points, const Facing& facing) noexcept;

}  // namespace touchmark::bvh
