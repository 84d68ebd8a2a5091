#include "core/exact/distance_predicates.h"

#include <climits>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/exact/big_integer.h"
#include "core/exact/exact_square.h"
#include "core/exact/integer_lattice.h"

namespace touchmark {
namespace {

using exact::Grid;
using exact::Integer;
using exact::Scaled;
using exact::Vector;

/// A point of the triangle, in grid units: seen from the query point it is at way * along / across, and the
/// square of its distance is numerator / denominator.
struct ExactFoot {
  Integer<6> numerator;
  Integer<4> denominator;
  Vector<3> way;
  Integer<3> along;
  Integer<4> across;
};

std::strong_ordering compare(const ExactFoot& a, const ExactFoot& b) noexcept {
  return a.numerator * b.denominator <=> b.numerator * a.denominator;
}

ExactFoot at_corner(const Vector<1>& w) noexcept {
  const auto one = Integer<1>::one();
  return {dot(w, w), one, {w[0], w[1], w[2]}, one, one};
}

/// On the segment from w to v. One of no length is its corner.
ExactFoot on_segment(const Vector<1>& w, const Vector<1>& v) noexcept {
  const Vector<1> edge = v - w;
  const Integer<2> squared = dot(edge, edge), along = -dot(w, edge);
  if (along.sign() <= 0) return at_corner(w);
  if (along >= squared) return at_corner(v);
  const Vector<2> moment = cross(w, edge);
  Vector<3> way;
  for (std::size_t k = 0; k < 3; ++k) way[k] = w[k] * squared + edge[k] * along;
  return {dot(moment, moment), squared, way, Integer<1>::one(), squared};
}

/// The nearest point of the triangle whose corners, seen from the query point, are at w.
ExactFoot nearest_foot(const std::array<Vector<1>, 3>& w) noexcept {
  const Vector<2> normal = cross(w[1] - w[0], w[2] - w[0]);
  bool over_face = !is_zero(normal);
  // The normal of side ij in the plane, (w_j - w_i) x (0 - w_i), is w_i x w_j.
  for (std::size_t i = 0; i < 3 && over_face; ++i)
    over_face = dot(cross(w[i], w[(i + 1) % 3]), normal).sign() >= 0;
  if (over_face) {
    const Integer<3> height = dot(w[0], normal);
    const Integer<4> squared = dot(normal, normal);
    return {height * height, squared, {normal[0], normal[1], normal[2]}, height, squared};
  }
  ExactFoot best = on_segment(w[0], w[1]);
  for (std::size_t i = 1; i < 3; ++i) {
    const ExactFoot other = on_segment(w[i], w[(i + 1) % 3]);
    if (compare(other, best) < 0) best = other;
  }
  return best;
}

ExactFoot nearest_foot(const Grid& grid, const TriangleCorners& triangle, const Vec3& point) noexcept {
  const Vector<1> origin = grid(point);
  return nearest_foot({grid(triangle[0]) - origin, grid(triangle[1]) - origin, grid(triangle[2]) - origin});
}

/// A way as seen from its start: it leads to `way`, the triangle's corners are at `w`.
struct ExactWay {
  Vector<1> way;
  std::array<Vector<1>, 3> w;
  Integer<2> squared_radius;
};

/// Does it go through the triangle? A way along the triangle's plane is left to ends, corners and edges.
bool passes_through(const ExactWay& c) noexcept {
  const Vector<2> normal = cross(c.w[1] - c.w[0], c.w[2] - c.w[0]);
  const Integer<3> start = dot(c.w[0], normal), drop = dot(c.way, normal);
  const int sign = drop.sign();
  if (sign == 0) return false;
  // It meets the plane at start / drop of the way, and there the barycentric coordinates are to each other
  // as these products.
  if (sign > 0 ? start.sign() < 0 || start > drop : start.sign() > 0 || start < drop) return false;
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(c.way, cross(c.w[i], c.w[(i + 1) % 3])).sign() * sign < 0) return false;
  return true;
}

/// Does its inside come within the radius of this corner?
bool passes_corner(const ExactWay& c, const Vector<1>& w) noexcept {
  const Integer<2> along = dot(w, c.way), squared = dot(c.way, c.way);
  if (along.sign() <= 0 || along >= squared) return false;
  const Vector<2> moment = cross(w, c.way);
  return dot(moment, moment) <= c.squared_radius * squared;
}

/// Does its inside come within the radius of the inside of the edge from w to v? False where they are
/// parallel: then an end of one is as near.
bool passes_edge(const ExactWay& c, const Vector<1>& w, const Vector<1>& v) noexcept {
  const Vector<1> edge = v - w;
  const Vector<2> normal = cross(c.way, edge);
  const Integer<4> determinant = dot(normal, normal);
  if (determinant.sign() == 0) return false;
  const Integer<2> across = dot(c.way, edge), along_way = dot(c.way, w), along_edge = dot(edge, w);
  const Integer<4> on_way = along_way * dot(edge, edge) - across * along_edge;
  const Integer<4> on_edge = across * along_way - dot(c.way, c.way) * along_edge;
  if (on_way.sign() < 0 || on_way > determinant || on_edge.sign() < 0 || on_edge > determinant) return false;
  const Integer<3> height = dot(w, normal);
  return height * height <= c.squared_radius * determinant;
}

bool end_is_within(const std::array<Vector<1>, 3>& w, const Integer<2>& squared_radius) noexcept {
  const ExactFoot foot = nearest_foot(w);
  return foot.numerator <= squared_radius * foot.denominator;
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
  int most = INT_MIN;
  for (const Scaled& x : v)
    if (x.fraction.high != 0) most = std::max(most, x.exponent);
  if (most == INT_MIN) return Vec3::Zero();
  Vec3 result;
  for (std::size_t k = 0; k < 3; ++k)
    result[static_cast<Eigen::Index>(k)] = std::ldexp(v[k].fraction.rounded(), v[k].exponent - most);
  return result.normalized();
}

template <int degree>
std::array<Scaled, 3> scaled(const Vector<degree>& v) noexcept {
  return {v[0].scaled(), v[1].scaled(), v[2].scaled()};
}

/// Of a distance to 98 bits. Where its lower half underflows, or it is beyond all doubles, nothing is known.
double error_of(double distance) noexcept {
  const bool known = distance > 0x1p-900 && !std::isinf(distance);
  return known ? 0x1p-97 * distance : std::numeric_limits<double>::infinity();
}

bool all_finite(const TriangleCorners& triangle, const Vec3& point) noexcept {
  return point.allFinite() && triangle[0].allFinite() && triangle[1].allFinite() && triangle[2].allFinite();
}

}  // namespace

exact::Square exact::square(const Grid& grid, const Feature& feature, const Vec3& point) noexcept {
  const Vector<1> origin = grid(point), w = grid(feature.corner[0]) - origin;
  if (feature.corners == 1) return {dot(w, w), Integer<1>::one()};
  const Vector<1> edge = grid(feature.corner[1]) - origin - w;
  if (feature.corners == 2) {
    const Vector<2> moment = cross(w, edge);
    return {dot(moment, moment), dot(edge, edge)};
  }
  const Vector<2> normal = cross(edge, grid(feature.corner[2]) - origin - w);
  const Integer<3> height = dot(w, normal);
  return {height * height, dot(normal, normal)};
}

exact::Square exact::square(const Grid& grid, const TriangleCorners& triangle, const Vec3& point) noexcept {
  const ExactFoot foot = nearest_foot(grid, triangle, point);
  return {foot.numerator, foot.denominator};
}

bool within_exactly(const TriangleCorners& triangle, const Vec3& point, double radius) noexcept {
  if (!(radius >= 0) || !all_finite(triangle, point)) return false;
  if (std::isinf(radius)) return true;
  Grid grid(triangle, point);
  grid.add(radius);
  const ExactFoot foot = nearest_foot(grid, triangle, point);
  const Integer<1> r = grid(radius);
  return foot.numerator <= r * r * foot.denominator;
}

bool way_within_exactly(const TriangleCorners& triangle, const Vec3& from, const Vec3& to, double fraction,
                        double radius) noexcept {
  if (!(radius >= 0) || !all_finite(triangle, from) || !to.allFinite()) return false;
  if (std::isinf(radius)) return true;
  Grid grid(triangle, from);
  grid.add(to);
  grid.add(radius);
  // On a grid so much finer that the part ends on it, too.
  const exact::Limb fine = fraction < 1 ? exact::Limb{1} << 53 : 1;
  const auto part = static_cast<exact::Limb>(fraction * static_cast<double>(fine));
  const Vector<1> origin = grid(from);
  ExactWay c{times(grid(to) - origin, part), {}, {}};
  for (std::size_t i = 0; i < 3; ++i) c.w[i] = times(grid(triangle[i]) - origin, fine);
  const Integer<1> r = grid(radius).times(fine);
  c.squared_radius = r * r;
  if (passes_through(c)) return true;
  for (std::size_t i = 0; i < 3; ++i)
    if (passes_corner(c, c.w[i]) || passes_edge(c, c.w[i], c.w[(i + 1) % 3])) return true;
  return end_is_within(c.w, c.squared_radius) ||
         end_is_within({c.w[0] - c.way, c.w[1] - c.way, c.w[2] - c.way}, c.squared_radius);
}

std::strong_ordering compare_exactly(const TriangleCorners& a, const TriangleCorners& b,
                                     const Vec3& point) noexcept {
  Grid grid(a, point);
  grid.add(b);
  return compare(nearest_foot(grid, a, point), nearest_foot(grid, b, point));
}

std::partial_ordering compare(const Foot& a, const Foot& b) noexcept {
  const double error = a.error + b.error;
  // Where one is infinite so is its error, and the difference may be no number.
  if (std::isinf(error)) return std::partial_ordering::unordered;
  if (error == 0) {
    const std::partial_ordering order = a.distance.high <=> b.distance.high;
    return order != 0 ? order : a.distance.low <=> b.distance.low;
  }
  const double difference = (a.distance.high - b.distance.high) + (a.distance.low - b.distance.low);
  return std::abs(difference) > error ? difference <=> 0 : std::partial_ordering::unordered;
}

Foot foot_exactly(const TriangleCorners& triangle, const Vec3& point) noexcept {
  const Grid grid(triangle, point);
  const ExactFoot foot = nearest_foot(grid, triangle, point);
  Foot result;
  result.distance = root(foot.numerator.scaled(), foot.denominator.scaled(), grid.exponent());
  result.error = error_of(result.distance.high);
  if (foot.numerator.sign() == 0) return result;
  const std::array<Scaled, 3> way = scaled(foot.way);
  const Scaled part = foot.along.scaled() / foot.across.scaled();
  for (std::size_t k = 0; k < 3; ++k) {
    Scaled towards = way[k] * part;
    towards.exponent += grid.exponent();
    result.offset[static_cast<Eigen::Index>(k)] = -towards.rounded();
  }
  result.direction = foot.along.sign() > 0 ? Vec3(-unit(way)) : unit(way);
  return result;
}

Vec3 normal_exactly(const TriangleCorners& triangle) noexcept {
  const Grid grid(triangle, triangle[0]);
  const Vector<1> origin = grid(triangle[0]);
  return unit(scaled(cross(grid(triangle[1]) - origin, grid(triangle[2]) - origin)));
}

}  // namespace touchmark
