/// The bounding volume of a child: a sphere cut by a slab.
#pragma once

#include <span>

#include <Eigen/Core>

#include "core/probe.h"

namespace touchmark::spheres {

/// In the tree's frame, in single precision: the points within `radius` of the axis through `center` along
/// `normal`, and within `half` of the centre along it.
struct SlabbedSphere {
  Eigen::Vector3f center;
  float radius;
  Eigen::Vector3f normal;  ///< unit, but for its rounding
  float half;
};

/// Holds every point, for certain. The slab lies across `mean_normal` (of any length; where it is zero any
/// slab is as good). The sphere is within a few per cent of the smallest.
SlabbedSphere bound_points(std::span<const Vec3> points, const Vec3& mean_normal) noexcept;

}  // namespace touchmark::spheres
