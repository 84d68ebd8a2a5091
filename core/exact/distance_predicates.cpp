#include "core/exact/distance_predicates.h"

#include <cmath>
#include <optional>
#include <utility>

#include "core/exact/big_integer.h"
#include "core/exact/exact_closest_point.h"
#include "core/exact/exact_square.h"
#include "core/exact/integer_lattice.h"
#include "core/exact/orientation.h"

namespace touchmark {
namespace {

using exact::BigInteger;
using exact::Lattice;
using exact::Vector;
using ExactClosestPoint = exact::ExactClosestPoint<1>;

exact::Corners<1> corners_from(const Lattice& lattice, const TriangleCorners& triangle,
                               const Vector<1>& origin) noexcept {
  return {lattice(triangle[0]) - origin, lattice(triangle[1]) - origin, lattice(triangle[2]) - origin};
}

ExactClosestPoint closest_of(const Lattice& lattice, const TriangleCorners& triangle,
                             const Vec3& point) noexcept {
  return exact::exact_closest_point<1>(corners_from(lattice, triangle, lattice(point)));
}

bool all_finite(const TriangleCorners& triangle, const Vec3& point) noexcept {
  return point.allFinite() && triangle[0].allFinite() && triangle[1].allFinite() && triangle[2].allFinite();
}

/// meets_by_sides of a path in the triangle's plane. They are apart where a side of one has the other
/// strictly beyond it.
std::optional<bool> meets_in_plane(const TriangleCorners& triangle, const Vec3& from,
                                   const Vec3& to) noexcept {
  Eigen::Index dropped = 0;
  const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  normal.cwiseAbs().maxCoeff(&dropped);
  const auto flat = [&](const Vec3& v) { return Vec3(v[(dropped + 1) % 3], v[(dropped + 2) % 3], 0); };
  const Vec3 a = flat(triangle[0]), b = flat(triangle[1]), c = flat(triangle[2]), p = flat(from),
             q = flat(to);
  const int turn = side_of_line_xy(a, b, c);
  if (turn == 0) return std::nullopt;
  for (const auto& [v, w] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
    if (side_of_line_xy(v, w, p) == -turn && side_of_line_xy(v, w, q) == -turn) return false;
  const int beyond = side_of_line_xy(p, q, a);
  return beyond == 0 || side_of_line_xy(p, q, b) != beyond || side_of_line_xy(p, q, c) != beyond;
}

exact::ExactPath<1> path_on(const Lattice& lattice, const TriangleCorners& triangle, const Vec3& from,
                            const Vec3& to) noexcept {
  const Vector<1> origin = lattice(from);
  return {lattice(to) - origin, corners_from(lattice, triangle, origin), {}};
}

}  // namespace

exact::Square exact::square(const Lattice& lattice, const Feature& feature, const Vec3& point) noexcept {
  const Vector<1> origin = lattice(point), w = lattice(feature.corner[0]) - origin;
  if (feature.corners == 1) return {dot(w, w), BigInteger<1>::one()};
  const Vector<1> edge = lattice(feature.corner[1]) - origin - w;
  if (feature.corners == 2) {
    const Vector<2> moment = cross(w, edge);
    return {dot(moment, moment), dot(edge, edge)};
  }
  const Vector<2> normal = cross(edge, lattice(feature.corner[2]) - origin - w);
  const BigInteger<3> height = dot(w, normal);
  return {height * height, dot(normal, normal)};
}

exact::Square exact::square(const Lattice& lattice, const TriangleCorners& triangle,
                            const Vec3& point) noexcept {
  const ExactClosestPoint closest = closest_of(lattice, triangle, point);
  return {closest.numerator, closest.denominator};
}

std::optional<bool> meets_by_sides(const TriangleCorners& triangle, const Vec3& from,
                                   const Vec3& to) noexcept {
  const auto& [a, b, c] = triangle;
  const int first = side_of_plane(a, b, c, from), last = side_of_plane(a, b, c, to);
  if (first == 0 && last == 0) return meets_in_plane(triangle, from, to);
  if (first == last) return false;
  if (first == 0 || last == 0) {
    const Vec3& in_plane = first == 0 ? from : to;
    return meets_in_plane(triangle, in_plane, in_plane);
  }
  // The three have the signs of the barycentric coordinates of the place where the path meets the plane.
  const int ab = side_of_plane(from, to, a, b), bc = side_of_plane(from, to, b, c);
  if (ab * bc < 0) return false;
  const int ca = side_of_plane(from, to, c, a);
  return ab * ca >= 0 && bc * ca >= 0;
}

bool within_exactly(const TriangleCorners& triangle, const Vec3& point, double radius) noexcept {
  if (!(radius >= 0) || !all_finite(triangle, point)) return false;
  if (std::isinf(radius)) return true;
  if (radius == 0 && side_of_plane(triangle[0], triangle[1], triangle[2], point) != 0) return false;
  Lattice lattice(triangle, point);
  lattice.add(radius);
  const ExactClosestPoint closest = closest_of(lattice, triangle, point);
  const BigInteger<1> r = lattice(radius);
  return closest.numerator <= r * r * closest.denominator;
}

bool path_within_exactly(const TriangleCorners& triangle, const Vec3& from, const Vec3& to, double fraction,
                         double radius) noexcept {
  if (!(radius >= 0) || !all_finite(triangle, from) || !to.allFinite()) return false;
  if (std::isinf(radius)) return true;
  Lattice lattice(triangle, from);
  lattice.add(to);
  lattice.add(radius);
  // On a grid so much finer that the part ends on it, too.
  const exact::Limb fine = fraction < 1 ? exact::Limb{1} << 53 : 1;
  const auto part = static_cast<exact::Limb>(fraction * static_cast<double>(fine));
  exact::ExactPath<1> path = path_on(lattice, triangle, from, to);
  path.path = times(path.path, part);
  for (Vector<1>& w : path.w) w = times(w, fine);
  const BigInteger<1> r = lattice(radius).times(fine);
  path.squared_radius = r * r;
  return comes_within(path);
}

double first_meeting_exactly(const TriangleCorners& triangle, const Vec3& from, const Vec3& to) noexcept {
  Lattice lattice(triangle, from);
  lattice.add(to);
  return std::nextafter(exact::first_meeting(path_on(lattice, triangle, from, to)).rounded(), 0.0);
}

std::strong_ordering compare_exactly(const TriangleCorners& a, const TriangleCorners& b,
                                     const Vec3& point) noexcept {
  Lattice lattice(a, point);
  lattice.add(b);
  return compare(closest_of(lattice, a, point), closest_of(lattice, b, point));
}

std::partial_ordering compare(const ClosestPoint& a, const ClosestPoint& b) noexcept {
  const double error = a.error + b.error;
  // An infinite one has an infinite error, and the difference may be no number.
  if (std::isinf(error)) return std::partial_ordering::unordered;
  if (error == 0) {
    const std::partial_ordering order = a.distance.high <=> b.distance.high;
    return order != 0 ? order : a.distance.low <=> b.distance.low;
  }
  const double difference = (a.distance.high - b.distance.high) + (a.distance.low - b.distance.low);
  return std::abs(difference) > error ? difference <=> 0 : std::partial_ordering::unordered;
}

ClosestPoint closest_point_exactly(const TriangleCorners& triangle, const Vec3& point) noexcept {
  const Lattice lattice(triangle, point);
  return exact::rounded(closest_of(lattice, triangle, point), lattice.exponent());
}

Vec3 normal_exactly(const TriangleCorners& triangle) noexcept {
  const Lattice lattice(triangle, triangle[0]);
  const Vector<1> origin = lattice(triangle[0]);
  return unit(scaled(cross(lattice(triangle[1]) - origin, lattice(triangle[2]) - origin)));
}

}  // namespace touchmark
