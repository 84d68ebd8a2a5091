#include "core/bvh/build/bounding_cylinder.h"

#include <cmath>
#include <limits>

namespace touchmark::bvh {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

Point4 broadcast_point(const Eigen::Vector3f& p) noexcept {
  return {broadcast(p.x()), broadcast(p.y()), broadcast(p.z())};
}
Point4 operator-(const Point4& a, const Point4& b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Lanes dot(const Point4& a, const Point4& b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point4 cross(const Point4& a, const Point4& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Eigen::Vector3f middle_of_box(const PointList& points) noexcept {
  Point4 min = points.fours().front(), max = min;
  for (const Point4& p : points.fours()) {
    min = {simd::min(min.x, p.x), simd::min(min.y, p.y), simd::min(min.z, p.z)};
    max = {simd::max(max.x, p.x), simd::max(max.y, p.y), simd::max(max.z, p.z)};
  }
  return 0.5F * Eigen::Vector3f(simd::reduce_min(min.x) + simd::reduce_max(max.x),
                                simd::reduce_min(min.y) + simd::reduce_max(max.y),
                                simd::reduce_min(min.z) + simd::reduce_max(max.z));
}

struct Farthest {
  Eigen::Vector3f point;
  float squared;
};

Farthest farthest_from(const Eigen::Vector3f& center, const PointList& points) noexcept {
  const Point4 from = broadcast_point(center);
  Lanes largest = broadcast(-1);
  LaneBits at = {0, 0, 0, 0};
  int i = 0;
  for (const Point4& p : points.fours()) {
    const Point4 to = p - from;
    const Lanes squared = dot(to, to);
    const LaneBits farther = squared > largest;
    largest = simd::max(squared, largest);
    at = farther ? LaneBits{i, i, i, i} : at;
    ++i;
  }
  int lane = 0;
  for (int k = 1; k < 4; ++k)
    if (largest[k] > largest[lane]) lane = k;
  const Point4& p = points.fours()[static_cast<std::size_t>(at[lane])];
  return {{p.x[lane], p.y[lane], p.z[lane]}, largest[lane]};
}

/// The centre of a nearly smallest sphere: steps towards the farthest point, each shorter than the last, end
/// within 1/steps of it. Badoiu and Clarkson, "Smaller core-sets for balls" (2003).
Eigen::Vector3f central_point(const PointList& points) noexcept {
  Eigen::Vector3f center = middle_of_box(points), best = center;
  float least = infinity;
  const int steps = points.size() <= 64 ? 12 : points.size() <= 4096 ? 4 : 1;
  for (int step = 1; step <= steps; ++step) {
    const Farthest farthest = farthest_from(center, points);
    if (farthest.squared < least) {
      least = farthest.squared;
      best = center;
    }
    center += (farthest.point - center) / static_cast<float>(step + 3);
  }
  return best;
}

Eigen::Vector3f direction_of(const Vec3& v) noexcept {
  const double length = v.norm();
  return length > 0 ? Eigen::Vector3f((v / length).cast<float>()) : Eigen::Vector3f::UnitZ();
}

/// Returns the cylinder along this unit axis, through nearly this point.
BoundingCylinder bound_along(const Eigen::Vector3f& direction, Eigen::Vector3f center,
                             const PointList& points) noexcept {
  const Point4 axis = broadcast_point(direction);
  Point4 from = broadcast_point(center);
  Lanes low = broadcast(infinity), high = broadcast(-infinity);
  for (const Point4& p : points.fours()) {
    const Lanes along = dot(axis, p - from);
    low = simd::min(low, along);
    high = simd::max(high, along);
  }
  center += 0.5F * (simd::reduce_min(low) + simd::reduce_max(high)) * direction;
  from = broadcast_point(center);
  Lanes max_along = {}, max_across = {};
  for (const Point4& p : points.fours()) {
    const Point4 to = p - from, across = cross(axis, to);
    const Lanes along = dot(axis, to);
    max_along = simd::max(max_along, simd::max(along, -along));
    max_across = simd::max(max_across, dot(across, across));
  }
  // With u = 2^-24: a point's coordinates were rounded by u each, its difference to the centre relatively by
  // u; sums and products add 12 u of the way from the centre, the axis's length 2 u, the last rounding one
  // more.
  const float half = simd::reduce_max(max_along), radius = std::sqrt(simd::reduce_max(max_across));
  const float pad = 0x1p-20F * (half + radius) + 0x1p-22F;
  return {center, radius + pad, direction, half + pad};
}

/// Proportional to the volume of what is within `margin` of the cylinder, but for its rounded rims.
float volume_within(const BoundingCylinder& bound, float margin) noexcept {
  const float across = bound.radius + margin;
  return across * across * (bound.half + margin);
}

/// A surface that covers less of its bound's disc than this part is looked at more closely.
constexpr double min_cover = 0.3;
/// From how far off bounds are compared, in parts of the first one's size.
constexpr float comparing_margin = 0.05F;
/// With more points than this a closer look takes too long.
constexpr std::size_t max_compared = 4096;

}  // namespace

BoundingCylinder bound_points(const PointList& points, const Facing& facing) noexcept {
  const Eigen::Vector3f center = central_point(points);
  BoundingCylinder best = bound_along(direction_of(facing.sum), center, points);
  const double disc = 3.14 * static_cast<double>(best.radius) * static_cast<double>(best.radius);
  // Only the side that faces along the axis covers the disc: a closed plate has two, which cancel.
  if (facing.sum.norm() >= 2 * min_cover * disc || points.size() > max_compared) return best;
  const float margin = comparing_margin * (best.radius + best.half);
  const Eigen::Vector3f end = farthest_from(center, points).point;
  const Eigen::Vector3f other_end = farthest_from(end, points).point;
  for (const Vec3& axis : {facing.largest, Vec3((other_end - end).cast<double>())}) {
    const BoundingCylinder bound = bound_along(direction_of(axis), center, points);
    if (volume_within(bound, margin) < volume_within(best, margin)) best = bound;
  }
  return best;
}

}  // namespace touchmark::bvh
