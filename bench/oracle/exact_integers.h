/// Doubles as integers on a common grid of 2^exponent, and vectors of them. For the .cpp files of the exact
/// decisions only: nothing else sees GMP.
#pragma once

#include <algorithm>
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
  void add(double x) { exponent_ = std::min(exponent_, parts_of(x).exponent); }
  void add(const Vec3& v) {
    for (const double x : {v.x(), v.y(), v.z()}) add(x);
  }
  void add(const Triangle& t) {
    for (const Vec3& v : t) add(v);
  }

  /// 0 when only zeros were put in.
  int exponent() const { return exponent_ == INT_MAX ? 0 : exponent_; }

  Integer operator()(double x) const {
    const Parts parts = parts_of(x);
    Integer integer(static_cast<long>(parts.mantissa));
    if (parts.mantissa != 0) integer <<= static_cast<mp_bitcnt_t>(parts.exponent - exponent());
    return integer;
  }
  Vector operator()(const Vec3& v) const { return {(*this)(v.x()), (*this)(v.y()), (*this)(v.z())}; }

 private:
  int exponent_ = INT_MAX;
};

}  // namespace touchmark::bench::oracle::exact
