/// The points of segments and triangles that are nearest to a query point, in integers. For the .cpp files of
/// the exact decisions only.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <optional>
#include <utility>

#include "bench/oracle/exact/exact_integers.h"

namespace touchmark::bench::oracle::exact {

/// A squared distance, numerator / denominator, in squared grid units.
struct Square {
  Integer numerator, denominator;

  bool operator<(const Square& other) const {
    return Integer(numerator * other.denominator) < Integer(other.numerator * denominator);
  }
};

/// Compares a distance with one whose square is whole.
inline std::strong_ordering order(const Square& a, const Integer& b) {
  return order(a.numerator, Integer(b * a.denominator));
}

/// The nearest point of a triangle, relative to the query point, lies along `direction` (any length, zero for
/// distance zero); it is direction * along / across.
struct Foot {
  Square square;
  Vector direction;
  Integer along, across;
};

inline Foot at_corner(const Vector& w) { return {{dot(w, w), 1}, w, 1, 1}; }

/// On the segment from w to v; a segment of no length is its corner.
inline Foot on_segment(const Vector& w, const Vector& v) {
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
inline std::optional<Foot> on_face(const std::array<Vector, 3>& w) {
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
inline Foot nearest_on(const std::array<Vector, 3>& w) {
  if (std::optional<Foot> face = on_face(w)) return *std::move(face);
  Foot best = on_segment(w[0], w[1]);
  for (std::size_t i = 1; i < 3; ++i) {
    Foot other = on_segment(w[i], w[(i + 1) % 3]);
    if (other.square < best.square) best = std::move(other);
  }
  return best;
}

/// The corners relative to the query point.
template <class AnyTriangle>
std::array<Vector, 3> relative(const Grid& grid, const Vector& origin, const AnyTriangle& t) {
  const std::array<Vector, 3> corners = grid(t);
  return {corners[0] - origin, corners[1] - origin, corners[2] - origin};
}

}  // namespace touchmark::bench::oracle::exact
