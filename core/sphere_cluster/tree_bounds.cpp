#include "core/sphere_cluster/tree_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/geometry/aabb.h"

namespace touchmark::spheres {
namespace {

/// The centre of a nearly smallest sphere: steps towards the farthest point, each shorter than the last, end
/// within 1/steps of it. Badoiu and Clarkson, "Smaller core-sets for balls" (2003).
Vec3 central_point(std::span<const Vec3> points) noexcept {
  Aabb box;
  for (const Vec3& p : points) box.extend(p);
  Vec3 center = box.center(), best = center;
  double least = std::numeric_limits<double>::infinity();
  const int steps = points.size() <= 64 ? 24 : points.size() <= 4096 ? 8 : 1;
  for (int step = 1; step <= steps; ++step) {
    double most = -1;
    const Vec3* farthest = nullptr;
    for (const Vec3& p : points) {
      const double squared = (p - center).squaredNorm();
      if (squared > most) {
        most = squared;
        farthest = &p;
      }
    }
    if (most < least) {
      least = most;
      best = center;
    }
    center += (*farthest - center) / (step + 3);
  }
  return best;
}

/// Up to the next float, with room for the few roundings of the double before it.
float rounded_up(double x) noexcept {
  constexpr double roundings = 1 + 64 * std::numeric_limits<double>::epsilon();
  return std::nextafter(static_cast<float>(x * roundings), std::numeric_limits<float>::infinity());
}

}  // namespace

SlabbedSphere bound_points(std::span<const Vec3> points, const Vec3& mean_normal) noexcept {
  const double length = mean_normal.norm();
  const Eigen::Vector3f normal =
      length > 0 ? Eigen::Vector3f((mean_normal / length).cast<float>()) : Eigen::Vector3f::UnitZ();
  // From here on the rounded normal and centre are the ones that are meant.
  const Vec3 axis = normal.cast<double>();
  Vec3 middle = central_point(points);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : points) {
    const double along = axis.dot(p - middle);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  middle += 0.5 * (low + high) * axis;
  const Eigen::Vector3f center = middle.cast<float>();
  const Vec3 exact_center = center.cast<double>(), unit = axis.normalized();
  double half = 0, squared_radius = 0;
  for (const Vec3& p : points) {
    const Vec3 to = p - exact_center;
    half = std::max(half, std::abs(unit.dot(to)));
    squared_radius = std::max(squared_radius, unit.cross(to).squaredNorm());
  }
  return {center, rounded_up(std::sqrt(squared_radius)), normal, rounded_up(half)};
}

}  // namespace touchmark::spheres
