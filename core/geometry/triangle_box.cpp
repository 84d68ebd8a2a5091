#include "core/geometry/triangle_box.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

namespace touchmark {
namespace {

/// Do the projections on this axis lie apart by more than rounding? Apart on any axis is apart, so the axis
/// itself may be rounded; `error` bounds the error of the coordinates of `v` and `half` and of three-term
/// sums of them.
bool separates(const Vec3& axis, const std::array<Vec3, 3>& v, const Vec3& half, double error) noexcept {
  const double a = axis.dot(v[0]), b = axis.dot(v[1]), c = axis.dot(v[2]);
  const double reach = axis.cwiseAbs().dot(half) + axis.cwiseAbs().sum() * error;
  return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
}

}  // namespace

bool overlaps(const std::array<Vec3, 3>& corner, const Aabb& box) noexcept {
  const Vec3 center = box.center(), half = 0.5 * box.extent();
  const std::array<Vec3, 3> v = {corner[0] - center, corner[1] - center, corner[2] - center};
  double largest = half.maxCoeff();
  for (const Vec3& w : v) largest = std::max(largest, w.cwiseAbs().maxCoeff());
  // The differences and the products round in proportion to `largest`, the centre to the coordinates
  // themselves.
  const double error =
      std::numeric_limits<double>::epsilon() * (8 * largest + 2 * center.cwiseAbs().maxCoeff());
  for (int k = 0; k < 3; ++k)
    if (separates(Vec3::Unit(k), v, half, error)) return false;
  const std::array<Vec3, 3> edge = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  if (separates(edge[0].cross(edge[1]), v, half, error)) return false;
  for (const Vec3& e : edge)
    for (int k = 0; k < 3; ++k)
      if (separates(Vec3::Unit(k).cross(e), v, half, error)) return false;
  return true;
}

}  // namespace touchmark
