/// The square of a distance as a quotient of whole numbers, kept so that many can be compared with one.
#pragma once

#include <compare>

#include "core/exact/big_integer.h"
#include "core/exact/feature.h"
#include "core/exact/integer_lattice.h"
#include "core/probe.h"

namespace touchmark::exact {

/// A square in units of 4^exponent of a grid.
struct Square {
  BigInteger<6> numerator;
  BigInteger<4> denominator;
};

inline std::strong_ordering compare(const Square& a, const Square& b) noexcept {
  return a.numerator * b.denominator <=> b.numerator * a.denominator;
}

/// Returns the squared distance of the point from the corner, the line or the plane of the feature, on a
/// lattice that holds all of them.
Square square(const Lattice& lattice, const Feature& feature, const Vec3& point) noexcept;
/// Returns the squared distance of the point from the triangle, on a lattice that holds both.
Square square(const Lattice& lattice, const TriangleCorners& triangle, const Vec3& point) noexcept;

}  // namespace touchmark::exact
