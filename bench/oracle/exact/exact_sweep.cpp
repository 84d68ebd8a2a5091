// The distance between a segment and a triangle is zero where they cross, and else lies between an end of the
// segment and the triangle, a corner and the segment, or the insides of the segment and of an edge.
#include <array>
#include <cmath>

#include "bench/oracle/exact/exact_distance.h"
#include "bench/oracle/exact/exact_integers.h"
#include "bench/oracle/exact/feet.h"

namespace touchmark::bench::oracle {
namespace {

using exact::Grid;
using exact::Integer;
using exact::Vector;

/// `path` is the segment, from the origin; `w` are the triangle's corners.
struct Configuration {
  Vector path;
  std::array<Vector, 3> w;
  Integer squared_radius;
};

bool cross_through_the_face(const Configuration& c) {
  const Vector normal = cross(c.w[1] - c.w[0], c.w[2] - c.w[0]);
  const Integer start = -dot(c.w[0], normal);
  const Integer drop = -dot(c.path, normal);  // start - end
  // In the plane (or no plane): if they meet at all, then at an end, a corner or an edge.
  if (drop == 0) return false;
  const bool reaches = drop > 0 ? (start >= 0 && start <= drop) : (start <= 0 && start >= drop);
  if (!reaches) return false;
  // The crossing point is start / drop of the path. Times drop, which squared is positive:
  const Vector q = scaled(start, c.path);
  std::array<Vector, 3> from_q;
  for (std::size_t i = 0; i < 3; ++i) from_q[i] = scaled(drop, c.w[i]) - q;
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(cross(from_q[i], from_q[(i + 1) % 3]), normal) < 0) return false;
  return true;
}

/// How the distance between the insides of the path and of an edge compares; greater if the least distance of
/// their lines is not inside both.
std::strong_ordering compare_inside(const Configuration& c, const Vector& w, const Vector& v) {
  const Vector edge = v - w;
  const Vector normal = cross(c.path, edge);
  const Integer determinant = dot(normal, normal);
  if (determinant == 0) return std::strong_ordering::greater;
  // Least |w + t edge - s path|^2: s path.path - t path.edge = path.w and -s path.edge + t edge.edge =
  // -edge.w.
  const Integer a = dot(c.path, c.path), b = dot(c.path, edge), e = dot(edge, edge);
  const Integer d = dot(c.path, w), f = dot(edge, w);
  const Integer s = d * e - b * f, t = b * d - a * f;
  if (s < 0 || s > determinant || t < 0 || t > determinant) return std::strong_ordering::greater;
  const Integer height = dot(w, normal);
  return exact::order(Integer(height * height), Integer(c.squared_radius * determinant));
}

/// How the distance between a corner and the path compares.
std::strong_ordering compare_corner(const Configuration& c, const Vector& w) {
  return exact::order(on_segment(Vector{0, 0, 0} - w, c.path - w).square, c.squared_radius);
}

/// How the distance between the path's end and the triangle compares.
std::strong_ordering compare_end(const Configuration& c) {
  return exact::order(exact::nearest_on({c.w[0] - c.path, c.w[1] - c.path, c.w[2] - c.path}).square,
                      c.squared_radius);
}

/// The part of the path as seen from its start, on a grid as much finer as the fraction's last digit asks
/// for.
template <class AnyTriangle>
Configuration part_of(const Vec3& from, const Vec3& to, double fraction, const AnyTriangle& triangle,
                      double radius, double more) {
  const Grid grid(from, to, triangle, radius, more);
  const exact::Parts parts = exact::parts_of(fraction);
  Integer part(static_cast<long>(parts.mantissa)), fine(1);
  if (parts.mantissa != 0 && parts.exponent < 0) fine <<= static_cast<mp_bitcnt_t>(-parts.exponent);
  const Vector origin = grid(from);
  const Integer r = fine * (grid(radius) + grid(more));
  Configuration c{scaled(part, grid(to) - origin), {}, Integer(r * r)};
  const std::array<Vector, 3> corners = relative(grid, origin, triangle);
  for (std::size_t i = 0; i < 3; ++i) c.w[i] = scaled(fine, corners[i]);
  return c;
}

}  // namespace

template <class AnyTriangle>
std::strong_ordering compare_distance_on_path(const Vec3& from, const Vec3& to, double fraction,
                                              const AnyTriangle& triangle, double radius, double more) {
  if (std::isinf(radius)) return std::strong_ordering::less;
  return compare_end(part_of(from, to, fraction, triangle, radius, more));
}

template <class AnyTriangle>
std::strong_ordering compare_part_distance(const Vec3& from, const Vec3& to, double fraction,
                                           const AnyTriangle& triangle, double radius, double more) {
  if (std::isinf(radius)) return std::strong_ordering::less;
  std::strong_ordering least = compare_distance(from, triangle, radius, more);
  if (least < 0) return least;
  const Configuration c = part_of(from, to, fraction, triangle, radius, more);
  least = exact::lesser(least, compare_end(c));
  if (cross_through_the_face(c)) least = exact::lesser(least, exact::order(Integer(0), c.squared_radius));
  for (std::size_t i = 0; i < 3 && least >= 0; ++i) {
    least = exact::lesser(least, compare_corner(c, c.w[i]));
    least = exact::lesser(least, compare_inside(c, c.w[i], c.w[(i + 1) % 3]));
  }
  return least;
}

template std::strong_ordering compare_distance_on_path(const Vec3&, const Vec3&, double, const Triangle&,
                                                       double, double);
template std::strong_ordering compare_distance_on_path(const Vec3&, const Vec3&, double,
                                                       const PlacedTriangle&, double, double);
template std::strong_ordering compare_part_distance(const Vec3&, const Vec3&, double, const Triangle&, double,
                                                    double);
template std::strong_ordering compare_part_distance(const Vec3&, const Vec3&, double, const PlacedTriangle&,
                                                    double, double);

}  // namespace touchmark::bench::oracle
