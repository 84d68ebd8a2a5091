/// Distances and paths in whole numbers, for triangles whose corners are polynomials of any degree in
/// doubles: of degree 1 where the doubles are the corners, of degree 2 where a rotation moves them.
///
/// For the .cpp files of exact predicates only.
#pragma once

#include <array>
#include <climits>
#include <cmath>
#include <compare>
#include <cstddef>
#include <limits>

#include "core/exact/big_integer.h"
#include "core/exact/distance_predicates.h"
#include "core/probe.h"

namespace touchmark::exact {

/// A triangle's corners as seen from the query point, in grid units.
template <int degree>
using Corners = std::array<Vector<degree>, 3>;

/// A point of the triangle, in grid units: seen from the query point it is at direction * along / across, and
/// the square of its distance is numerator / denominator.
template <int c>
struct ExactClosestPoint {
  BigInteger<6 * c> numerator;
  BigInteger<4 * c> denominator;
  Vector<3 * c> direction;
  BigInteger<3 * c> along;
  BigInteger<4 * c> across;
};

template <int c>
std::strong_ordering compare(const ExactClosestPoint<c>& a, const ExactClosestPoint<c>& b) noexcept {
  return a.numerator * b.denominator <=> b.numerator * a.denominator;
}

template <int c>
ExactClosestPoint<c> closest_at_corner(const Vector<c>& w) noexcept {
  const auto one = BigInteger<c>::one();
  return {dot(w, w), one, {w[0], w[1], w[2]}, one, one};
}

/// Returns the closest point of the segment from w to v. A segment of no length is its corner.
template <int c>
ExactClosestPoint<c> closest_on_segment(const Vector<c>& w, const Vector<c>& v) noexcept {
  const Vector<c> edge = v - w;
  const BigInteger<2 *c> squared = dot(edge, edge), along = -dot(w, edge);
  if (along.sign() <= 0) return closest_at_corner<c>(w);
  if (along >= squared) return closest_at_corner<c>(v);
  const Vector<2 * c> moment = cross(w, edge);
  Vector<3 * c> direction;
  for (std::size_t k = 0; k < 3; ++k) direction[k] = w[k] * squared + edge[k] * along;
  return {dot(moment, moment), squared, direction, BigInteger<c>::one(), squared};
}

/// The nearest point of the triangle whose corners, seen from the query point, are at w.
template <int c>
ExactClosestPoint<c> exact_closest_point(const Corners<c>& w) noexcept {
  const Vector<2 * c> normal = cross(w[1] - w[0], w[2] - w[0]);
  bool over_face = !is_zero(normal);
  // The normal of side ij in the plane, (w_j - w_i) x (0 - w_i), is w_i x w_j.
  for (std::size_t i = 0; i < 3 && over_face; ++i)
    over_face = dot(cross(w[i], w[(i + 1) % 3]), normal).sign() >= 0;
  if (over_face) {
    const BigInteger<3 * c> height = dot(w[0], normal);
    const BigInteger<4 * c> squared = dot(normal, normal);
    return {height * height, squared, {normal[0], normal[1], normal[2]}, height, squared};
  }
  ExactClosestPoint<c> best = closest_on_segment<c>(w[0], w[1]);
  for (std::size_t i = 1; i < 3; ++i) {
    const ExactClosestPoint<c> other = closest_on_segment<c>(w[i], w[(i + 1) % 3]);
    if (compare(other, best) < 0) best = other;
  }
  return best;
}

/// A path as seen from its start: it leads to `path`, the triangle's corners are at `w`.
template <int c>
struct ExactPath {
  Vector<c> path;
  Corners<c> w;
  BigInteger<2 * c> squared_radius;
};

/// Does it go through the triangle? A path along the triangle's plane is left to ends, corners and edges.
template <int c>
bool passes_through(const ExactPath<c>& p) noexcept {
  const Vector<2 * c> normal = cross(p.w[1] - p.w[0], p.w[2] - p.w[0]);
  const BigInteger<3 *c> start = dot(p.w[0], normal), drop = dot(p.path, normal);
  const int sign = drop.sign();
  if (sign == 0) return false;
  // It meets the plane at start / drop of the path, and there the barycentric coordinates are to each other
  // as these products.
  if (sign > 0 ? start.sign() < 0 || start > drop : start.sign() > 0 || start < drop) return false;
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(p.path, cross(p.w[i], p.w[(i + 1) % 3])).sign() * sign < 0) return false;
  return true;
}

/// Does its inside come within the radius of this corner?
template <int c>
bool passes_corner(const ExactPath<c>& p, const Vector<c>& w) noexcept {
  const BigInteger<2 *c> along = dot(w, p.path), squared = dot(p.path, p.path);
  if (along.sign() <= 0 || along >= squared) return false;
  const Vector<2 * c> moment = cross(w, p.path);
  return dot(moment, moment) <= p.squared_radius * squared;
}

/// Does its inside come within the radius of the inside of the edge from w to v? False where they are
/// parallel: then an end of one is as near.
template <int c>
bool passes_edge(const ExactPath<c>& p, const Vector<c>& w, const Vector<c>& v) noexcept {
  const Vector<c> edge = v - w;
  const Vector<2 * c> normal = cross(p.path, edge);
  const BigInteger<4 * c> determinant = dot(normal, normal);
  if (determinant.sign() == 0) return false;
  const BigInteger<2 *c> across = dot(p.path, edge), along_path = dot(p.path, w), along_edge = dot(edge, w);
  const BigInteger<4 * c> on_path = along_path * dot(edge, edge) - across * along_edge;
  const BigInteger<4 * c> on_edge = across * along_path - dot(p.path, p.path) * along_edge;
  if (on_path.sign() < 0 || on_path > determinant || on_edge.sign() < 0 || on_edge > determinant)
    return false;
  const BigInteger<3 * c> height = dot(w, normal);
  return height * height <= p.squared_radius * determinant;
}

template <int c>
bool end_is_within(const Corners<c>& w, const BigInteger<2 * c>& squared_radius) noexcept {
  const ExactClosestPoint<c> closest = exact_closest_point<c>(w);
  return closest.numerator <= squared_radius * closest.denominator;
}

/// Does any point of the path come within the radius of the triangle?
template <int c>
bool comes_within(const ExactPath<c>& p) noexcept {
  if (passes_through(p)) return true;
  for (std::size_t i = 0; i < 3; ++i)
    if (passes_corner(p, p.w[i]) || passes_edge(p, p.w[i], p.w[(i + 1) % 3])) return true;
  return end_is_within<c>(p.w, p.squared_radius) ||
         end_is_within<c>({p.w[0] - p.path, p.w[1] - p.path, p.w[2] - p.path}, p.squared_radius);
}

/// Returns where on its path a bare point first meets the triangle. The path meets it.
template <int c>
Scaled first_meeting(const ExactPath<c>& p) noexcept {
  const Vector<2 * c> normal = cross(p.w[1] - p.w[0], p.w[2] - p.w[0]);
  const BigInteger<3 * c> drop = dot(p.path, normal);
  if (drop.sign() != 0) return dot(p.w[0], normal).scaled() / drop.scaled();
  if (end_is_within<c>(p.w, {})) return {};
  Scaled first{{1}, 0};
  const auto consider = [&](const auto& on_path, const auto& whole) {
    if (on_path.sign() < 0 || on_path > whole) return;
    const Scaled part = on_path.scaled() / whole.scaled();
    if (part.rounded() < first.rounded()) first = part;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector<c>&w = p.w[i], edge = p.w[(i + 1) % 3] - w;
    const Vector<2 *c> moment = cross(w, p.path), across = cross(p.path, edge);
    if (is_zero(moment)) consider(dot(w, p.path), dot(p.path, p.path));
    const BigInteger<4 *c> whole = dot(across, across), on_edge = dot(moment, across);
    if (whole.sign() == 0 || dot(w, across).sign() != 0 || on_edge.sign() < 0 || on_edge > whole) continue;
    consider(dot(cross(w, edge), across), whole);
  }
  return first;
}

/// Square root of a quotient, in units of 2^exponent.
inline DoubleDouble root(const Scaled& numerator, const Scaled& denominator, int exponent) noexcept {
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
inline Vec3 unit(const std::array<Scaled, 3>& v) noexcept {
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
inline double error_of(double distance) noexcept {
  const bool known = distance > 0x1p-900 && !std::isinf(distance);
  return known ? 0x1p-97 * distance : std::numeric_limits<double>::infinity();
}

/// Rounds at the end. A grid unit is 2^exponent.
template <int c>
ClosestPoint rounded(const ExactClosestPoint<c>& closest, int exponent) noexcept {
  ClosestPoint result;
  result.distance = root(closest.numerator.scaled(), closest.denominator.scaled(), exponent);
  result.error = error_of(result.distance.high);
  if (closest.numerator.sign() == 0) return result;
  const std::array<Scaled, 3> direction = scaled(closest.direction);
  const Scaled part = closest.along.scaled() / closest.across.scaled();
  for (std::size_t k = 0; k < 3; ++k) {
    Scaled towards = direction[k] * part;
    towards.exponent += exponent;
    result.offset[static_cast<Eigen::Index>(k)] = -towards.rounded();
  }
  result.direction = closest.along.sign() > 0 ? Vec3(-unit(direction)) : unit(direction);
  return result;
}

}  // namespace touchmark::exact
