#include "core/sphere_cluster/tree/bounding_cylinder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchmark::spheres {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

float least_lane(Lanes v) noexcept { return std::min(std::min(v[0], v[1]), std::min(v[2], v[3])); }
float greatest_lane(Lanes v) noexcept { return std::max(std::max(v[0], v[1]), std::max(v[2], v[3])); }

Point4 spread(const Eigen::Vector3f& p) noexcept {
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
    min = {lesser_of(min.x, p.x), lesser_of(min.y, p.y), lesser_of(min.z, p.z)};
    max = {greater_of(max.x, p.x), greater_of(max.y, p.y), greater_of(max.z, p.z)};
  }
  return 0.5F * Eigen::Vector3f(least_lane(min.x) + greatest_lane(max.x),
                                least_lane(min.y) + greatest_lane(max.y),
                                least_lane(min.z) + greatest_lane(max.z));
}

struct Farthest {
  Eigen::Vector3f point;
  float squared;
};

Farthest farthest_from(const Eigen::Vector3f& center, const PointList& points) noexcept {
  const Point4 from = spread(center);
  Lanes most = broadcast(-1);
  LaneBits at = {0, 0, 0, 0};
  int i = 0;
  for (const Point4& p : points.fours()) {
    const Point4 to = p - from;
    const Lanes squared = dot(to, to);
    const LaneBits farther = squared > most;
    most = greater_of(squared, most);
    at = farther ? LaneBits{i, i, i, i} : at;
    ++i;
  }
  int lane = 0;
  for (int k = 1; k < 4; ++k)
    if (most[k] > most[lane]) lane = k;
  const Point4& p = points.fours()[static_cast<std::size_t>(at[lane])];
  return {{p.x[lane], p.y[lane], p.z[lane]}, most[lane]};
}

/// The centre of a nearly smallest sphere: steps towards the farthest point, each shorter than the last, end
/// within 1/steps of it. Badoiu and Clarkson, "Smaller core-sets for balls" (2003).
Eigen::Vector3f central_point(const PointList& points) noexcept {
  Eigen::Vector3f center = middle_of_box(points), best = center;
  float least = infinity;
  const int steps = points.size() <= 64 ? 24 : points.size() <= 4096 ? 8 : 1;
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

}  // namespace

SlabbedSphere bound_points(const PointList& points, const Vec3& mean_normal) noexcept {
  const double length = mean_normal.norm();
  const Eigen::Vector3f normal =
      length > 0 ? Eigen::Vector3f((mean_normal / length).cast<float>()) : Eigen::Vector3f::UnitZ();
  const Point4 axis = spread(normal);
  Eigen::Vector3f center = central_point(points);
  Point4 from = spread(center);
  Lanes low = broadcast(infinity), high = broadcast(-infinity);
  for (const Point4& p : points.fours()) {
    const Lanes along = dot(axis, p - from);
    low = lesser_of(low, along);
    high = greater_of(high, along);
  }
  center += 0.5F * (least_lane(low) + greatest_lane(high)) * normal;
  from = spread(center);
  Lanes most_along = {}, most_across = {};
  for (const Point4& p : points.fours()) {
    const Point4 to = p - from, across = cross(axis, to);
    const Lanes along = dot(axis, to);
    most_along = greater_of(most_along, greater_of(along, -along));
    most_across = greater_of(most_across, dot(across, across));
  }
  // With u = 2^-24: a point's coordinates were rounded by u each, its difference to the centre relatively by
  // u; sums and products add 12 u of the way from the centre, the axis's length 2 u, the last rounding one
  // more.
  const float half = greatest_lane(most_along), radius = std::sqrt(greatest_lane(most_across));
  const float rounding = 0x1p-20F * (half + radius) + 0x1p-22F;
  return {center, radius + rounding, normal, half + rounding};
}

}  // namespace touchmark::spheres
