#include "bench/oracle/placed_surface.h"

#include <cmath>
#include <compare>

#include "bench/oracle/exact/exact_distance.h"
#include "bench/oracle/placed_bounds.h"

namespace touchmark::bench::oracle {
namespace {

/// Is the point nearer to a round body's axis than the surface is, by more than this?
bool is_inside_by(const Vec3& point, const PlacedTriangle& round, double margin) {
  return margin < round.radius && compare_distance(point, round, round.radius, -margin) < 0;
}
bool is_outside_by(const Vec3& point, const PlacedTriangle& round, double margin) {
  return compare_distance(point, round, round.radius, margin) > 0;
}

/// A face, which keeps its edges and both ends that far away.
bool is_surely_pierced(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle, double margin) {
  if (!is_within(from, to, triangle, 0)) return false;
  if (is_within(from, triangle, margin) || is_within(to, triangle, margin)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = triangle.corners[i], &b = triangle.corners[(i + 1) % 3];
    if (is_within(from, to, {{a, b, b}, triangle.pose}, margin)) return false;
  }
  return true;
}

}  // namespace

bool is_within(const Vec3& point, const PlacedTriangle& triangle, double radius) {
  const Interval distance = bounds_of(point, triangle);
  if (distance.hi <= radius) return true;
  if (distance.lo > radius) return false;
  return compare_distance(point, triangle, radius, triangle.radius) <= 0 &&
         !is_inside_by(point, triangle, radius);
}

bool is_within(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle, double radius) {
  const Interval distance = bounds_of(from, to, triangle);
  if (distance.hi <= radius) return true;
  if (distance.lo > radius) return false;
  // The distance to the axis is convex along the segment: one inside at both ends is inside all the way.
  return compare_segment_distance(from, to, triangle, radius, triangle.radius) <= 0 &&
         !(is_inside_by(from, triangle, radius) && is_inside_by(to, triangle, radius));
}

bool is_nearer(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle, double radius) {
  const Interval distance = bounds_of(from, to, triangle);
  if (distance.hi < radius) return true;
  if (distance.lo >= radius) return false;
  const auto is_far_inside = [&](const Vec3& end) {
    return radius <= triangle.radius && compare_distance(end, triangle, triangle.radius, -radius) <= 0;
  };
  return compare_segment_distance(from, to, triangle, radius, triangle.radius) < 0 &&
         !(is_far_inside(from) && is_far_inside(to));
}

bool is_within_on_path(const Sweep& sweep, double fraction, const PlacedTriangle& triangle, double radius) {
  const auto compare = [&](double more) {
    return compare_distance_on_path(sweep.from, sweep.to, fraction, triangle, triangle.radius, more);
  };
  return compare(radius) <= 0 && (radius >= triangle.radius || compare(-radius) >= 0);
}

bool is_touched_before(const Sweep& sweep, double fraction, const PlacedTriangle& triangle) {
  const Vec3 &from = sweep.from, &to = sweep.to;
  const double radius = sweep.radius;
  if (is_inside_by(from, triangle, radius))
    return compare_distance_on_path(from, to, fraction, triangle, triangle.radius, -radius) > 0;
  const auto up_to = [&](double part) {
    return compare_part_distance(from, to, part, triangle, radius, triangle.radius);
  };
  const std::strong_ordering order = up_to(fraction);
  if (order != 0) return order < 0;
  // At the very radius: only from here on?
  return compare_distance_on_path(from, to, fraction, triangle, radius, triangle.radius) != 0 ||
         up_to(std::nextafter(fraction, 0)) <= 0;
}

bool is_surely_crossed(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle, double margin) {
  if (!(triangle.radius > 0)) return is_surely_pierced(from, to, triangle, margin);
  if (is_inside_by(from, triangle, margin)) return is_outside_by(to, triangle, margin);
  if (!is_outside_by(from, triangle, margin)) return false;
  if (is_inside_by(to, triangle, margin)) return true;
  return is_outside_by(to, triangle, margin) && margin < triangle.radius &&
         compare_segment_distance(from, to, triangle, triangle.radius, -margin) < 0;
}

}  // namespace touchmark::bench::oracle
