#include "core/exact/distance_predicates.h"

#include <climits>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/exact/big_integer.h"
#include "core/exact/exact_square.h"
#include "core/exact/integer_lattice.h"

namespace touchmark {
namespace {

using exact::BigInteger;
using exact::Lattice;
using exact::Scaled;
using exact::Vector;

/// A point of the triangle, in grid units: seen from the query point it is at direction * along / across, and
/// the square of its distance is numerator / denominator.
struct ExactClosestPoint {
  BigInteger<6> numerator;
  BigInteger<4> denominator;
  Vector<3> direction;
  BigInteger<3> along;
  BigInteger<4> across;
};

std::strong_ordering compare(const ExactClosestPoint& a, const ExactClosestPoint& b) noexcept {
  return a.numerator * b.denominator <=> b.numerator * a.denominator;
}

ExactClosestPoint at_corner(const Vector<1>& w) noexcept {
  const auto one = BigInteger<1>::one();
  return {dot(w, w), one, {w[0], w[1], w[2]}, one, one};
}

/// Returns the closest point of the segment from w to v. A segment of no length is its corner.
ExactClosestPoint on_segment(const Vector<1>& w, const Vector<1>& v) noexcept {
  const Vector<1> edge = v - w;
  const BigInteger<2> squared = dot(edge, edge), along = -dot(w, edge);
  if (along.sign() <= 0) return at_corner(w);
  if (along >= squared) return at_corner(v);
  const Vector<2> moment = cross(w, edge);
  Vector<3> direction;
  for (std::size_t k = 0; k < 3; ++k) direction[k] = w[k] * squared + edge[k] * along;
  return {dot(moment, moment), squared, direction, BigInteger<1>::one(), squared};
}

/// The nearest point of the triangle whose corners, seen from the query point, are at w.
ExactClosestPoint exact_closest_point(const std::array<Vector<1>, 3>& w) noexcept {
  const Vector<2> normal = cross(w[1] - w[0], w[2] - w[0]);
  bool over_face = !is_zero(normal);
  // The normal of side ij in the plane, (w_j - w_i) x (0 - w_i), is w_i x w_j.
  for (std::size_t i = 0; i < 3 && over_face; ++i)
    over_face = dot(cross(w[i], w[(i + 1) % 3]), normal).sign() >= 0;
  if (over_face) {
    const BigInteger<3> height = dot(w[0], normal);
    const BigInteger<4> squared = dot(normal, normal);
    return {height * height, squared, {normal[0], normal[1], normal[2]}, height, squared};
  }
  ExactClosestPoint best = on_segment(w[0], w[1]);
  for (std::size_t i = 1; i < 3; ++i) {
    const ExactClosestPoint other = on_segment(w[i], w[(i + 1) % 3]);
    if (compare(other, best) < 0) best = other;
  }
  return best;
}

ExactClosestPoint exact_closest_point(const Lattice& lattice, const TriangleCorners& triangle,
                                      const Vec3& point) noexcept {
  const Vector<1> origin = lattice(point);
  return exact_closest_point(
      {lattice(triangle[0]) - origin, lattice(triangle[1]) - origin, lattice(triangle[2]) - origin});
}

/// A path as seen from its start: it leads to `path`, the triangle's corners are at `w`.
struct ExactPath {
  Vector<1> path;
  std::array<Vector<1>, 3> w;
  BigInteger<2> squared_radius;
};

/// Does it go through the triangle? A path along the triangle's plane is left to ends, corners and edges.
bool passes_through(const ExactPath& c) noexcept {
  const Vector<2> normal = cross(c.w[1] - c.w[0], c.w[2] - c.w[0]);
  const BigInteger<3> start = dot(c.w[0], normal), drop = dot(c.path, normal);
  const int sign = drop.sign();
  if (sign == 0) return false;
  // It meets the plane at start / drop of the path, and there the barycentric coordinates are to each other
  // as these products.
  if (sign > 0 ? start.sign() < 0 || start > drop : start.sign() > 0 || start < drop) return false;
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(c.path, cross(c.w[i], c.w[(i + 1) % 3])).sign() * sign < 0) return false;
  return true;
}

/// Does its inside come within the radius of this corner?
bool passes_corner(const ExactPath& c, const Vector<1>& w) noexcept {
  const BigInteger<2> along = dot(w, c.path), squared = dot(c.path, c.path);
  if (along.sign() <= 0 || along >= squared) return false;
  const Vector<2> moment = cross(w, c.path);
  return dot(moment, moment) <= c.squared_radius * squared;
}

/// Does its inside come within the radius of the inside of the edge from w to v? False where they are
/// parallel: then an end of one is as near.
bool passes_edge(const ExactPath& c, const Vector<1>& w, const Vector<1>& v) noexcept {
  const Vector<1> edge = v - w;
  const Vector<2> normal = cross(c.path, edge);
  const BigInteger<4> determinant = dot(normal, normal);
  if (determinant.sign() == 0) return false;
  const BigInteger<2> across = dot(c.path, edge), along_path = dot(c.path, w), along_edge = dot(edge, w);
  const BigInteger<4> on_path = along_path * dot(edge, edge) - across * along_edge;
  const BigInteger<4> on_edge = across * along_path - dot(c.path, c.path) * along_edge;
  if (on_path.sign() < 0 || on_path > determinant || on_edge.sign() < 0 || on_edge > determinant)
    return false;
  const BigInteger<3> height = dot(w, normal);
  return height * height <= c.squared_radius * determinant;
}

bool end_is_within(const std::array<Vector<1>, 3>& w, const BigInteger<2>& squared_radius) noexcept {
  const ExactClosestPoint closest = exact_closest_point(w);
  return closest.numerator <= squared_radius * closest.denominator;
}

/// Square root of a quotient, in units of 2^exponent.
DoubleDouble root(const Scaled& numerator, const Scaled& denominator, int exponent) noexcept {
  Scaled square = numerator / denominator;
  if (!(square.fraction.high > 0)) return {};
  if (square.exponent % 2 != 0) {
    square.fraction = square.fraction + square.fraction;
    --square.exponent;
  }
  const DoubleDouble fraction = square_root(square.fraction);
  const int scale = square.exponent / 2 + exponent;
  const double high = std::ldexp(fraction.high, scale);
  return {high, std::isinf(high) ? 0 : std::ldexp(fraction.low, scale)};
}

/// Unit, or zero: of any magnitude.
Vec3 unit(const std::array<Scaled, 3>& v) noexcept {
  int max = INT_MIN;
  for (const Scaled& x : v)
    if (x.fraction.high != 0) max = std::max(max, x.exponent);
  if (max == INT_MIN) return Vec3::Zero();
  Vec3 result;
  for (std::size_t k = 0; k < 3; ++k)
    result[static_cast<Eigen::Index>(k)] = std::ldexp(v[k].fraction.rounded(), v[k].exponent - max);
  return result.normalized();
}

template <int degree>
std::array<Scaled, 3> scaled(const Vector<degree>& v) noexcept {
  return {v[0].scaled(), v[1].scaled(), v[2].scaled()};
}

/// Returns the error of a distance to 98 bits. Where its lower half underflows, or it is beyond all doubles,
/// nothing is known.
double error_of(double distance) noexcept {
  const bool known = distance > 0x1p-900 && !std::isinf(distance);
  return known ? 0x1p-97 * distance : std::numeric_limits<double>::infinity();
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
  const ExactClosestPoint closest = exact_closest_point(lattice, triangle, point);
  return {closest.numerator, closest.denominator};
}

bool within_exactly(const TriangleCorners& triangle, const Vec3& point, double radius) noexcept {
  if (!(radius >= 0) || !all_finite(triangle, point)) return false;
  if (std::isinf(radius)) return true;
  Lattice lattice(triangle, point);
  lattice.add(radius);
  const ExactClosestPoint closest = exact_closest_point(lattice, triangle, point);
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
  ExactPath c{times(lattice(to) - origin, part), {}, {}};
  for (std::size_t i = 0; i < 3; ++i) c.w[i] = times(lattice(triangle[i]) - origin, fine);
  const BigInteger<1> r = lattice(radius).times(fine);
  c.squared_radius = r * r;
  if (passes_through(c)) return true;
  for (std::size_t i = 0; i < 3; ++i)
    if (passes_corner(c, c.w[i]) || passes_edge(c, c.w[i], c.w[(i + 1) % 3])) return true;
  return end_is_within(c.w, c.squared_radius) ||
         end_is_within({c.w[0] - c.path, c.w[1] - c.path, c.w[2] - c.path}, c.squared_radius);
}

std::strong_ordering compare_exactly(const TriangleCorners& a, const TriangleCorners& b,
                                     const Vec3& point) noexcept {
  Lattice lattice(a, point);
  lattice.add(b);
  return compare(exact_closest_point(lattice, a, point), exact_closest_point(lattice, b, point));
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
  const ExactClosestPoint closest = exact_closest_point(lattice, triangle, point);
  ClosestPoint result;
  result.distance = root(closest.numerator.scaled(), closest.denominator.scaled(), lattice.exponent());
  result.error = error_of(result.distance.high);
  if (closest.numerator.sign() == 0) return result;
  const std::array<Scaled, 3> direction = scaled(closest.direction);
  const Scaled part = closest.along.scaled() / closest.across.scaled();
  for (std::size_t k = 0; k < 3; ++k) {
    Scaled towards = direction[k] * part;
    towards.exponent += lattice.exponent();
    result.offset[static_cast<Eigen::Index>(k)] = -towards.rounded();
  }
  result.direction = closest.along.sign() > 0 ? Vec3(-unit(direction)) : unit(direction);
  return result;
}

Vec3 normal_exactly(const TriangleCorners& triangle) noexcept {
  const Lattice lattice(triangle, triangle[0]);
  const Vector<1> origin = lattice(triangle[0]);
  return unit(scaled(cross(lattice(triangle[1]) - origin, lattice(triangle[2]) - origin)));
}

}  // namespace touchmark
