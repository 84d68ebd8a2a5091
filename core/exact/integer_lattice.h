/// Doubles as whole numbers: the grid on which all the doubles of one question lie.
#pragma once

#include <algorithm>
#include <bit>
#include <climits>
#include <cstdint>

#include "core/exact/big_integer.h"
#include "core/exact/distance_predicates.h"

namespace touchmark::exact {

/// |x| == mantissa * 2^exponent, the mantissa odd or zero.
struct Parts {
  std::uint64_t mantissa;
  int exponent;

  explicit Parts(double x) noexcept {
    constexpr int digits = 52, bias = 1075;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const auto biased = static_cast<int>(bits >> digits & 0x7ff);
    mantissa = (bits & ((std::uint64_t{1} << digits) - 1)) | (biased > 0 ? std::uint64_t{1} << digits : 0);
    const int zeros = mantissa == 0 ? 0 : std::countr_zero(mantissa);
    mantissa >>= zeros;
    exponent = std::max(biased, 1) - bias + zeros;
  }
};

/// The coarsest power of two of which every number put in is a multiple.
class Lattice {
 public:
  Lattice() noexcept = default;
  Lattice(const TriangleCorners& triangle, const Vec3& point) noexcept {
    add(triangle);
    add(point);
  }
  void add(double x) noexcept {
    if (x != 0) exponent_ = std::min(exponent_, Parts(x).exponent);
  }
  void add(const Vec3& v) noexcept {
    for (const double x : {v.x(), v.y(), v.z()}) add(x);
  }
  void add(const TriangleCorners& triangle) noexcept {
    for (const Vec3& corner : triangle) add(corner);
  }

  /// 0 where only zeros were put in.
  int exponent() const noexcept { return exponent_ == INT_MAX ? 0 : exponent_; }
  BigInteger<1> operator()(double x) const noexcept {
    if (x == 0) return {};
    const Parts parts(x);
    return BigInteger<1>::of(parts.mantissa, static_cast<unsigned>(parts.exponent - exponent()), x < 0);
  }
  Vector<1> operator()(const Vec3& v) const noexcept {
    return {(*this)(v.x()), (*this)(v.y()), (*this)(v.z())};
  }

 private:
  int exponent_ = INT_MAX;
};

}  // namespace touchmark::exact
