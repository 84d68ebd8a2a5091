#include "bench/oracle/exact_distance.h"

#include <array>
#include <optional>
#include <utility>

#include "bench/oracle/exact_integers.h"

namespace touchmark::bench::oracle {
namespace {

using exact::Grid;
using exact::Integer;
using exact::Vector;

/// A squared distance, numerator / denominator, in squared grid units.
struct Square {
  Integer numerator, denominator;

  bool operator<(const Square& other) const {
    return Integer(numerator * other.denominator) < Integer(other.numerator * denominator);
  }
};

/// The nearest point of a triangle, relative to the query point, lies along `direction` (any length, zero for
/// distance zero); it is direction * along / across.
struct Foot {
  Square square;
  Vector direction;
  Integer along, across;
};

Foot at_corner(const Vector& w) { return {{dot(w, w), 1}, w, 1, 1}; }

/// On the segment from w to v; a segment of no length is its corner.
Foot on_segment(const Vector& w, const Vector& v) {
  const Vector edge = v - w;
  const Integer length = dot(edge, edge);
  const Integer along = -dot(w, edge);
  if (along <= 0) return at_corner(w);
  if (along >= length) return at_corner(v);
  const Vector moment = cross(w, edge);
  // w + (along / length) edge, times length.
  const Vector a = scaled(length, w), b = scaled(along, edge);
  return {
      {dot(moment, moment), length}, {Integer(a.x + b.x), Integer(a.y + b.y), Integer(a.z + b.z)}, 1, length};
}

/// On the face's inside or border, if the query point is over it.
std::optional<Foot> on_face(const std::array<Vector, 3>& w) {
  const Vector normal = cross(w[1] - w[0], w[2] - w[0]);
  if (is_zero(normal)) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) {
    // The edge's normal in the plane, (w_j - w_i) x (0 - w_i), is w_i x w_j.
    if (dot(cross(w[i], w[(i + 1) % 3]), normal) < 0) return std::nullopt;
  }
  const Integer height = dot(w[0], normal);
  const Integer area = dot(normal, normal);
  return Foot{{Integer(height * height), area}, normal, height, area};
}

/// `w` are the corners relative to the query point.
Foot nearest_on(const std::array<Vector, 3>& w) {
  if (std::optional<Foot> face = on_face(w)) return *std::move(face);
  Foot best = on_segment(w[0], w[1]);
  for (std::size_t i = 1; i < 3; ++i) {
    Foot other = on_segment(w[i], w[(i + 1) % 3]);
    if (other.square < best.square) best = std::move(other);
  }
  return best;
}

template <class AnyTriangle>
std::array<Vector, 3> relative(const Grid& grid, const Vector& origin, const AnyTriangle& t) {
  const std::array<Vector, 3> corners = grid(t);
  return {corners[0] - origin, corners[1] - origin, corners[2] - origin};
}

std::size_t bits(const Integer& x) { return mpz_sizeinbase(x.get_mpz_t(), 2); }

/// numerator / denominator * 2^exponent, truncated to a double's digits.
double quotient(const Integer& numerator, const Integer& denominator, int exponent) {
  if (numerator == 0) return 0;
  const std::size_t want = bits(denominator) + 66;
  const std::size_t have = bits(numerator);
  const std::size_t shift = want > have ? want - have : 0;
  const Integer whole = Integer(numerator << shift) / denominator;
  signed long power = 0;
  const double fraction = mpz_get_d_2exp(&power, whole.get_mpz_t());
  return std::ldexp(fraction, static_cast<int>(power) - static_cast<int>(shift) + exponent);
}

/// The square root of s, in grid units of 2^exponent, as a sum of two doubles.
std::pair<double, double> root(const Square& s, int exponent) {
  if (s.numerator == 0) return {0, 0};
  // The integer root needs 130 bits, so the ratio 260; an even shift comes out of the root as its half.
  const std::size_t want = bits(s.denominator) + 262;
  const std::size_t have = bits(s.numerator);
  const std::size_t half_shift = want > have ? (want - have + 1) / 2 : 0;
  const Integer ratio = Integer(s.numerator << (2 * half_shift)) / s.denominator;
  const Integer whole = sqrt(ratio);
  signed long power = 0;
  const double first = mpz_get_d_2exp(&power, whole.get_mpz_t());
  const double leading = std::ldexp(first, 53);  // an integer; `whole` is it * 2^(power - 53), and a rest
  const Integer lead = Integer(leading) << static_cast<mp_bitcnt_t>(power - 53);
  signed long rest_power = 0;
  const double rest_fraction = mpz_get_d_2exp(&rest_power, Integer(whole - lead).get_mpz_t());
  const int scale = static_cast<int>(power) - static_cast<int>(half_shift) + exponent;
  const double rest = std::ldexp(rest_fraction, static_cast<int>(rest_power - power));
  const double high = first + rest;  // both below 1, `first` at least a half
  const double low = (first - high) + rest;
  return {std::ldexp(high, scale), std::ldexp(low, scale)};
}

Vec3 unit(const Vector& v, bool flip) {
  if (is_zero(v)) return Vec3::Zero();
  const std::array<const Integer*, 3> parts = {&v.x, &v.y, &v.z};
  std::array<double, 3> fraction{};
  std::array<signed long, 3> power{};
  signed long most = LONG_MIN;
  for (std::size_t i = 0; i < 3; ++i) {
    fraction[i] = mpz_get_d_2exp(&power[i], parts[i]->get_mpz_t());
    if (fraction[i] != 0) most = std::max(most, power[i]);
  }
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    const long below = fraction[i] == 0 ? 0 : std::max(power[i] - most, -2000L);
    result[static_cast<Eigen::Index>(i)] = std::ldexp(fraction[i], static_cast<int>(below));
  }
  result.normalize();
  return flip ? Vec3(-result) : result;
}

Vec3 absolute_position(const Vector& origin, const Foot& foot, int exponent) {
  const auto coordinate = [&](const Integer& o, const Integer& d) {
    return quotient(Integer(o * foot.across + d * foot.along), foot.across, exponent);
  };
  return {coordinate(origin.x, foot.direction.x), coordinate(origin.y, foot.direction.y),
          coordinate(origin.z, foot.direction.z)};
}

template <class AnyTriangle>
ExactNearest nearest_of(const Vec3& point, std::span<const AnyTriangle> triangles) {
  Grid grid;
  grid.add(point);
  for (const AnyTriangle& t : triangles) grid.add(t);
  const Vector origin = grid(point);
  ExactNearest nearest;
  Foot best;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Foot foot = nearest_on(relative(grid, origin, triangles[i]));
    if (i > 0 && !(foot.square < best.square)) continue;
    best = std::move(foot);
    nearest.which = i;
  }
  std::tie(nearest.high, nearest.low) = root(best.square, grid.exponent());
  nearest.point = absolute_position(origin, best, grid.exponent());
  // From the nearest point to the query point, so against the foot's own direction.
  if (best.square.numerator != 0) nearest.direction = unit(best.direction, best.along > 0);
  return nearest;
}

template <class AnyTriangle>
std::strong_ordering compare(const Vec3& point, const AnyTriangle& triangle, double radius) {
  if (std::isinf(radius)) return std::strong_ordering::less;
  Grid grid;
  grid.add(point);
  grid.add(triangle);
  grid.add(radius);
  const Foot foot = nearest_on(relative(grid, grid(point), triangle));
  const Integer r = grid(radius);
  return exact::order(foot.square.numerator, Integer(r * r * foot.square.denominator));
}

}  // namespace

ExactNearest nearest_exactly(const Vec3& point, std::span<const Triangle> triangles) {
  return nearest_of(point, triangles);
}
ExactNearest nearest_exactly(const Vec3& point, std::span<const PlacedTriangle> triangles) {
  return nearest_of(point, triangles);
}

std::strong_ordering compare_distance(const Vec3& point, const Triangle& triangle, double radius) {
  return compare(point, triangle, radius);
}
std::strong_ordering compare_distance(const Vec3& point, const PlacedTriangle& triangle, double radius) {
  return compare(point, triangle, radius);
}

}  // namespace touchmark::bench::oracle
