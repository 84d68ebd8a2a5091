/// Doubles as integers on a common grid of 2^exponent, and vectors of them. For the .cpp files of the exact
/// decisions only: nothing else sees GMP.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <climits>
#include <cmath>
#include <compare>
#include <cstdint>
#include <initializer_list>

#include <gmpxx.h>

#include "bench/oracle/triangle.h"

namespace touchmark::bench::oracle::exact {

using Integer = mpz_class;

struct Vector {
  Integer x, y, z;
};

inline Vector operator-(const Vector& a, const Vector& b) {
  return {Integer(a.x - b.x), Integer(a.y - b.y), Integer(a.z - b.z)};
}
inline Integer dot(const Vector& a, const Vector& b) { return Integer(a.x * b.x + a.y * b.y + a.z * b.z); }
inline Vector cross(const Vector& a, const Vector& b) {
  return {Integer(a.y * b.z - a.z * b.y), Integer(a.z * b.x - a.x * b.z), Integer(a.x * b.y - a.y * b.x)};
}
inline Vector scaled(const Integer& factor, const Vector& v) {
  return {Integer(factor * v.x), Integer(factor * v.y), Integer(factor * v.z)};
}
inline bool is_zero(const Vector& v) { return sgn(v.x) == 0 && sgn(v.y) == 0 && sgn(v.z) == 0; }

inline std::strong_ordering order(const Integer& a, const Integer& b) { return cmp(a, b) <=> 0; }

inline std::strong_ordering lesser(std::strong_ordering a, std::strong_ordering b) {
  if (a < 0 || b < 0) return std::strong_ordering::less;
  return a == 0 ? a : b;
}

/// x == mantissa * 2^exponent, mantissa odd or zero.
struct Parts {
  std::int64_t mantissa;
  int exponent;
};

inline Parts parts_of(double x) {
  if (x == 0) return {0, INT_MAX};
  int exponent = 0;
  const auto whole = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(whole));
  return {whole / (std::int64_t{1} << zeros), exponent - 53 + zeros};
}

/// The coarsest power of two of which every number put in is a multiple.
class Grid {
 public:
  template <class... Parts>
  explicit Grid(const Parts&... parts) {
    (add(parts), ...);
  }

  void add(double x) { exponent_ = std::min(exponent_, parts_of(x).exponent); }
  void add(const Vec3& v) {
    for (const double x : {v.x(), v.y(), v.z()}) add(x);
  }
  void add(const Triangle& t) {
    for (const Vec3& v : t) add(v);
  }

  /// Takes what the images of the corners are made of: products, and the translation.
  void add(const PlacedTriangle& t) {
    for (const Vec3& v : t.corners)
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) add_product(t.pose->rotation(row, column), v[column]);
    add(t.pose->translation);
    add(t.radius);
  }

  /// 0 when only zeros were put in.
  int exponent() const { return exponent_ == INT_MAX ? 0 : exponent_; }

  Integer operator()(double x) const {
    const Parts parts = parts_of(x);
    Integer integer(static_cast<long>(parts.mantissa));
    if (parts.mantissa != 0) integer <<= static_cast<mp_bitcnt_t>(parts.exponent - exponent());
    return integer;
  }
  /// Returns the image of a point.
  Vector operator()(const Pose& pose, const Vec3& v) const {
    std::array<Integer, 3> image;
    for (int row = 0; row < 3; ++row) {
      Integer& sum = image[static_cast<std::size_t>(row)];
      sum = (*this)(pose.translation[row]);
      for (int column = 0; column < 3; ++column) sum += product(pose.rotation(row, column), v[column]);
    }
    return {image[0], image[1], image[2]};
  }
  std::array<Vector, 3> operator()(const Triangle& t) const {
    return {(*this)(t[0]), (*this)(t[1]), (*this)(t[2])};
  }
  std::array<Vector, 3> operator()(const PlacedTriangle& t) const {
    return {(*this)(*t.pose, t.corners[0]), (*this)(*t.pose, t.corners[1]), (*this)(*t.pose, t.corners[2])};
  }
  Vector operator()(const Vec3& v) const { return {(*this)(v.x()), (*this)(v.y()), (*this)(v.z())}; }

 private:
  void add_product(double a, double b) {
    if (a != 0 && b != 0) exponent_ = std::min(exponent_, parts_of(a).exponent + parts_of(b).exponent);
  }
  Integer product(double a, double b) const {
    if (a == 0 || b == 0) return 0;
    const Parts left = parts_of(a), right = parts_of(b);
    Integer integer(static_cast<long>(left.mantissa));
    integer *= static_cast<long>(right.mantissa);
    integer <<= static_cast<mp_bitcnt_t>(left.exponent + right.exponent - exponent());
    return integer;
  }

  int exponent_ = INT_MAX;
};

}  // namespace touchmark::bench::oracle::exact
