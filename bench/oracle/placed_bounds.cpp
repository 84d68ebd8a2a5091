#include "bench/oracle/placed_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/oracle/float_limits.h"

namespace touchmark::bench::oracle {
namespace {

constexpr double smallest = std::numeric_limits<double>::denorm_min();

Interval widened(Interval bounds, double error) noexcept {
  if (!std::isfinite(error) || std::isnan(bounds.lo) || std::isnan(bounds.hi)) return {0, infinity};
  return {std::max(0.0, std::nextafter(bounds.lo - error, -infinity)),
          std::nextafter(bounds.hi + error, infinity)};
}

bool is_finite(const Triangle& triangle) noexcept {
  return std::ranges::all_of(triangle, [](const Vec3& v) { return v.allFinite(); });
}

}  // namespace

double rigidity(const Eigen::Matrix3d& r) noexcept {
  double squared = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double entry = r(0, i) * r(0, j) + r(1, i) * r(1, j) + r(2, i) * r(2, j) - (i == j ? 1.0 : 0.0);
      squared += entry * entry;
    }
  }
  return 1.01 * std::sqrt(squared) + 64 * unit_roundoff;
}

LocalPoint local(const Seen& body, const Vec3& point) noexcept {
  const Vec3 d = point - body.pose.translation;
  const Eigen::Matrix3d& r = body.pose.rotation;
  const Vec3 seen(r(0, 0) * d.x() + r(1, 0) * d.y() + r(2, 0) * d.z(),
                  r(0, 1) * d.x() + r(1, 1) * d.y() + r(2, 1) * d.z(),
                  r(0, 2) * d.x() + r(1, 2) * d.y() + r(2, 2) * d.z());
  const double error = (1.1 * body.rigid + 32 * unit_roundoff) * d.stableNorm() + 64 * smallest;
  return {seen, error};
}

RoundedImage rounded(const PlacedTriangle& triangle) noexcept {
  RoundedImage image{{}, 0};
  const Eigen::Matrix3d& r = triangle.pose->rotation;
  const Vec3& t = triangle.pose->translation;
  double largest = t.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& v = triangle.corners[i];
    for (int row = 0; row < 3; ++row)
      image.corners[i][row] = r(row, 0) * v.x() + r(row, 1) * v.y() + r(row, 2) * v.z() + t[row];
    largest = std::max(largest, 2 * v.cwiseAbs().sum());
  }
  // Six roundings a coordinate, of numbers no larger than the sums of these.
  image.error = 32 * unit_roundoff * largest + 16 * smallest;
  return image;
}

Interval bounds_of(const Vec3& point, const PlacedTriangle& triangle) noexcept {
  const RoundedImage image = rounded(triangle);
  if (!is_finite(image.corners)) return {0, infinity};
  const Interval to_image = widened(distance_interval(point, image.corners), image.error);
  const double radius = triangle.radius;
  if (!(radius > 0)) return to_image;
  const double beyond = to_image.lo - radius, within = radius - to_image.hi;
  return widened({std::max(beyond, within), std::max(to_image.hi - radius, radius - to_image.lo)}, 0);
}

Interval bounds_of(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle) noexcept {
  const RoundedImage image = rounded(triangle);
  if (!is_finite(image.corners)) return {0, infinity};
  const Interval to_image = widened(segment_distance_interval(from, to, image.corners), image.error);
  if (!(triangle.radius > 0)) return to_image;
  // A way that may come nearer to the axis than the surface is may be anywhere.
  if (!(to_image.lo > triangle.radius)) return {0, infinity};
  return widened({to_image.lo - triangle.radius, to_image.hi - triangle.radius}, 0);
}

}  // namespace touchmark::bench::oracle
