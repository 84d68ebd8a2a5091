// The distance between a segment and a triangle is zero where they cross, and else lies between an end of the
// segment and the triangle, a corner and the segment, or the insides of the segment and of an edge.
#include <algorithm>
#include <array>
#include <cmath>

#include "bench/oracle/exact_distance.h"
#include "bench/oracle/exact_integers.h"

namespace touchmark::bench {
namespace {

using exact::Grid;
using exact::Integer;
using exact::Vector;

/// `way` is the segment, from the origin; `w` are the triangle's corners.
struct Configuration {
  Vector way;
  std::array<Vector, 3> w;
  Integer squared_radius;
};

bool cross_through_the_face(const Configuration& c) {
  const Vector normal = cross(c.w[1] - c.w[0], c.w[2] - c.w[0]);
  const Integer start = -dot(c.w[0], normal);
  const Integer drop = -dot(c.way, normal);  // start - end
  // In the plane (or no plane): if they meet at all, then at an end, a corner or an edge.
  if (drop == 0) return false;
  const bool reaches = drop > 0 ? (start >= 0 && start <= drop) : (start <= 0 && start >= drop);
  if (!reaches) return false;
  // The crossing point is start / drop of the way. Times drop, which squared is positive:
  const Vector q = scaled(start, c.way);
  std::array<Vector, 3> from_q;
  for (std::size_t i = 0; i < 3; ++i) from_q[i] = scaled(drop, c.w[i]) - q;
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(cross(from_q[i], from_q[(i + 1) % 3]), normal) < 0) return false;
  return true;
}

/// How the distance between the insides of the way and of an edge compares; greater if the least distance of
/// their lines is not inside both.
std::strong_ordering compare_inside(const Configuration& c, const Vector& w, const Vector& v) {
  const Vector edge = v - w;
  const Vector normal = cross(c.way, edge);
  const Integer determinant = dot(normal, normal);
  if (determinant == 0) return std::strong_ordering::greater;
  // Least |w + t edge - s way|^2: s way.way - t way.edge = way.w and -s way.edge + t edge.edge = -edge.w.
  const Integer a = dot(c.way, c.way), b = dot(c.way, edge), e = dot(edge, edge);
  const Integer d = dot(c.way, w), f = dot(edge, w);
  const Integer s = d * e - b * f, t = b * d - a * f;
  if (s < 0 || s > determinant || t < 0 || t > determinant) return std::strong_ordering::greater;
  const Integer height = dot(w, normal);
  return exact::order(Integer(height * height), Integer(c.squared_radius * determinant));
}

/// How the distance between a corner and the way compares.
std::strong_ordering compare_corner(const Configuration& c, const Vector& w) {
  const Integer along = dot(w, c.way), length = dot(c.way, c.way);
  if (along <= 0) return exact::order(dot(w, w), c.squared_radius);
  if (along >= length) {
    const Vector to_end = w - c.way;
    return exact::order(dot(to_end, to_end), c.squared_radius);
  }
  const Vector moment = cross(w, c.way);
  return exact::order(dot(moment, moment), Integer(c.squared_radius * length));
}

}  // namespace

std::strong_ordering compare_segment_distance(const Vec3& from, const Vec3& to, const Triangle& triangle,
                                              double radius) {
  if (std::isinf(radius)) return std::strong_ordering::less;
  std::strong_ordering least =
      exact::lesser(compare_distance(from, triangle, radius), compare_distance(to, triangle, radius));
  if (least == std::strong_ordering::less) return least;
  Grid grid;
  grid.add(from);
  grid.add(to);
  grid.add(triangle);
  grid.add(radius);
  const Vector origin = grid(from);
  const Integer r = grid(radius);
  const Configuration c{grid(to) - origin,
                        {grid(triangle[0]) - origin, grid(triangle[1]) - origin, grid(triangle[2]) - origin},
                        Integer(r * r)};
  if (cross_through_the_face(c)) return exact::lesser(least, exact::order(Integer(0), c.squared_radius));
  for (std::size_t i = 0; i < 3; ++i) {
    least = exact::lesser(least, compare_corner(c, c.w[i]));
    least = exact::lesser(least, compare_inside(c, c.w[i], c.w[(i + 1) % 3]));
    if (least == std::strong_ordering::less) return least;
  }
  return least;
}

}  // namespace touchmark::bench
