#include "bench/oracle/exact/exact_distance.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "bench/oracle/exact/exact_integers.h"
#include "bench/oracle/exact/feet.h"

namespace touchmark::bench::oracle {
namespace {

using exact::Foot;
using exact::Grid;
using exact::Integer;
using exact::Square;
using exact::Vector;

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
  Grid grid(point);
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

/// The distance to a surface that is so far from a foot: |sqrt(square) - radius|, in grid units.
struct Height {
  mpq_class square;
  mpq_class radius;

  bool outside() const { return square >= radius * radius; }
};

/// Is sqrt(a) + more < sqrt(b)?
bool is_less(const mpq_class& a, const mpq_class& more, const mpq_class& b) {
  if (more >= 0) {  // 2 more sqrt(a) against the rest of b
    const mpq_class rest = b - a - more * more;
    return rest > 0 && mpq_class(4 * more * more * a) < rest * rest;
  }
  const mpq_class rest = a - b - more * more;  // against -2 more sqrt(b)
  return rest < 0 || rest * rest < mpq_class(4 * more * more * b);
}

bool operator<(const Height& a, const Height& b) {
  if (a.outside() && b.outside()) return is_less(a.square, b.radius - a.radius, b.square);
  if (!a.outside() && !b.outside()) return is_less(b.square, a.radius - b.radius, a.square);
  // sqrt(a) + sqrt(b) against the sum of the radii, both squared.
  const mpq_class sum = a.radius + b.radius, rest = sum * sum - a.square - b.square;
  const mpq_class product = 4 * a.square * b.square, squared = rest * rest;
  return a.outside() ? rest > 0 && product < squared : rest < 0 || product > squared;
}

/// A number as a sum of two doubles, in grid units of 2^exponent.
std::pair<double, double> halves(const mpf_class& x, int exponent) {
  signed long power = 0, rest_power = 0;
  const double first = mpf_get_d_2exp(&power, x.get_mpf_t());
  mpf_class leading(first, x.get_prec());
  if (power >= 0) {
    mpf_mul_2exp(leading.get_mpf_t(), leading.get_mpf_t(), static_cast<mp_bitcnt_t>(power));
  } else {
    mpf_div_2exp(leading.get_mpf_t(), leading.get_mpf_t(), static_cast<mp_bitcnt_t>(-power));
  }
  const mpf_class beyond(x - leading, x.get_prec());
  const double rest_fraction = mpf_get_d_2exp(&rest_power, beyond.get_mpf_t());
  const double rest = std::ldexp(rest_fraction, static_cast<int>(rest_power - power));
  const double high = first + rest, low = (first - high) + rest;
  const int scale = static_cast<int>(power) + exponent;
  return {std::ldexp(high, scale), std::ldexp(low, scale)};
}

/// To as many digits as a difference of the root and the radius can cancel, and 300 more.
std::pair<double, double> distance_of(const Height& height, int exponent) {
  const Integer &numerator = height.square.get_num(), &denominator = height.square.get_den();
  const mp_bitcnt_t digits =
      bits(numerator) + 2 * bits(denominator) + 2 * bits(height.radius.get_num()) + 300;
  const mpf_class square(mpf_class(numerator, digits) / mpf_class(denominator, digits), digits);
  const mpf_class root(sqrt(square), digits);
  return halves(mpf_class(abs(mpf_class(root - mpf_class(height.radius, digits), digits)), digits), exponent);
}

/// A unit vector across the axis.
Vec3 across(const Vec3& axis) {
  return axis.isZero(0) ? Vec3::UnitZ() : Vec3((axis / axis.cwiseAbs().maxCoeff()).unitOrthogonal());
}

ExactNearest nearest_of_surfaces(const Vec3& point, std::span<const PlacedTriangle> triangles) {
  Grid grid(point);
  for (const PlacedTriangle& t : triangles) grid.add(t);
  const Vector origin = grid(point);
  ExactNearest nearest;
  std::optional<Height> least;
  Foot best;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Foot foot = nearest_on(relative(grid, origin, triangles[i]));
    mpq_class square(foot.square.numerator, foot.square.denominator);
    square.canonicalize();
    const Height height{square, mpq_class(grid(triangles[i].radius))};
    if (least && !(height < *least)) continue;
    least = height;
    best = std::move(foot);
    nearest.which = i;
  }
  const PlacedTriangle& which = triangles[nearest.which];
  std::tie(nearest.high, nearest.low) = distance_of(*least, grid.exponent());
  const Vec3 outward = best.square.numerator != 0
                           ? unit(best.direction, best.along > 0)
                           : across(which.pose->rotation * (which.corners[1] - which.corners[0]));
  nearest.point = absolute_position(origin, best, grid.exponent()) + which.radius * outward;
  if (best.square.numerator != 0) nearest.direction = least->outside() ? outward : Vec3(-outward);
  return nearest;
}

}  // namespace

ExactNearest nearest_exactly(const Vec3& point, std::span<const Triangle> triangles) {
  return nearest_of(point, triangles);
}
ExactNearest nearest_exactly(const Vec3& point, std::span<const PlacedTriangle> triangles) {
  const bool round = std::ranges::any_of(triangles, [](const PlacedTriangle& t) { return t.radius > 0; });
  return round ? nearest_of_surfaces(point, triangles) : nearest_of(point, triangles);
}

template <class AnyTriangle>
std::strong_ordering compare_distance(const Vec3& point, const AnyTriangle& triangle, double radius,
                                      double more) {
  if (std::isinf(radius)) return std::strong_ordering::less;
  const Grid grid(point, triangle, radius, more);
  const Integer r = grid(radius) + grid(more);
  return exact::order(nearest_on(relative(grid, grid(point), triangle)).square, Integer(r * r));
}

template std::strong_ordering compare_distance(const Vec3&, const Triangle&, double, double);
template std::strong_ordering compare_distance(const Vec3&, const PlacedTriangle&, double, double);

}  // namespace touchmark::bench::oracle
