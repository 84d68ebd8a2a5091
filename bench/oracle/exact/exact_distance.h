/// Distances between the numbers as they are stored, decided in integers: every double is an integer times a
/// power of two, and a squared distance to a triangle is a ratio of two polynomials in them. No rounding
/// takes part in a decision; results are rounded once, at the end. Microseconds a call, no range limits:
/// finite coordinates never overflow or underflow.
#pragma once

#include <compare>
#include <cstddef>
#include <span>

#include "bench/oracle/triangle.h"

namespace touchmark::bench::oracle {

/// The distance to the nearest of some triangles.
struct ExactNearest {
  std::size_t which = 0;      ///< its place in the list; of several at exactly the same distance the first
  double high = 0;            ///< the distance, as a sum of two doubles: high is it rounded to nearest
  double low = 0;             ///< high + low is off by less than 2^-100 of it or one smallest double
  Vec3 point = Vec3::Zero();  ///< the nearest point of that triangle, each coordinate within one ulp
  Vec3 direction = Vec3::Zero();  ///< unit, from the nearest point to the query point, to a few ulp; zero
                                  ///< where the distance is exactly zero
};

/// `point` and all corners finite, at least one triangle.
ExactNearest nearest_exactly(const Vec3& point, std::span<const Triangle> triangles);
/// Works on the surfaces of bodies.
ExactNearest nearest_exactly(const Vec3& point, std::span<const PlacedTriangle> triangles);

/// How the distance from a point to a triangle compares with the exact sum of `radius`, which may be
/// infinite, and `more`; the sum is at least 0. Here and below AnyTriangle is Triangle, or PlacedTriangle for
/// the image of a body's triangle, whatever its radius.
template <class AnyTriangle>
std::strong_ordering compare_distance(const Vec3& point, const AnyTriangle& triangle, double radius,
                                      double more = 0);

/// Compares the distance to the part of the path from `from` to `to` up to `fraction` in [0, 1], which ends
/// at the very point from + fraction (to - from), be it a double or not.
template <class AnyTriangle>
std::strong_ordering compare_part_distance(const Vec3& from, const Vec3& to, double fraction,
                                           const AnyTriangle& triangle, double radius, double more = 0);

/// Compares the distance to the last point of that part alone.
template <class AnyTriangle>
std::strong_ordering compare_distance_on_path(const Vec3& from, const Vec3& to, double fraction,
                                              const AnyTriangle& triangle, double radius, double more = 0);

/// How the distance from the segment `from`-`to` to a triangle compares with the sum.
template <class AnyTriangle>
std::strong_ordering compare_segment_distance(const Vec3& from, const Vec3& to, const AnyTriangle& triangle,
                                              double radius, double more = 0) {
  return compare_part_distance(from, to, 1, triangle, radius, more);
}

}  // namespace touchmark::bench::oracle
