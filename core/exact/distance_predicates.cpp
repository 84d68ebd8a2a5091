#include "core/exact/distance_predicates.h"

#include <cmath>
#include <cstddef>

#include "core/exact/big_integer.h"
#include "core/exact/exact_closest_point.h"
#include "core/exact/exact_square.h"
#include "core/exact/integer_lattice.h"

namespace touchmark {
namespace {

using exact::BigInteger;
using exact::Lattice;
using exact::Vector;
using ExactClosestPoint = exact::ExactClosestPoint<1>;

ExactClosestPoint closest_of(const Lattice& lattice, const TriangleCorners& triangle,
                             const Vec3& point) noexcept {
  const Vector<1> origin = lattice(point);
  return exact::exact_closest_point<1>(
      {lattice(triangle[0]) - origin, lattice(triangle[1]) - origin, lattice(triangle[2]) - origin});
}

bool all_finite(const TriangleCorners& triangle, const Vec3& point) noexcept {
  return point.allFinite() && triangle[0].allFinite() && triangle[1].allFinite() && triangle[2].allFinite();
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

bool within_exactly(const TriangleCorners& triangle, const Vec3& point, double radius) noexcept {
  if (!(radius >= 0) || !all_finite(triangle, point)) return false;
  if (std::isinf(radius)) return true;
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
  const Vector<1> origin = lattice(from);
  exact::ExactPath<1> path{times(lattice(to) - origin, part), {}, {}};
  for (std::size_t i = 0; i < 3; ++i) path.w[i] = times(lattice(triangle[i]) - origin, fine);
  const BigInteger<1> r = lattice(radius).times(fine);
  path.squared_radius = r * r;
  return comes_within(path);
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
