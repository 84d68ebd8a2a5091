/// Whole numbers of bounded size, without allocation: what polynomials in doubles are when nothing rounds.
///
/// A polynomial of degree k in coordinates stays below 2^(2154 k), however they lie in the range of double
/// (docs/exactness.md, E8). Numbers of one magnitude need far less, and only the limbs in use are touched.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/exact/double_double.h"

namespace touchmark::exact {

using Limb = std::uint64_t;
/// Least significant first; the last one is not zero.
using Limbs = std::span<const Limb>;
__extension__ typedef unsigned __int128 TwoLimbs;

inline std::size_t trimmed(const Limb* limbs, std::size_t size) noexcept {
  while (size > 0 && limbs[size - 1] == 0) --size;
  return size;
}

inline std::strong_ordering compare(Limbs a, Limbs b) noexcept {
  if (a.size() != b.size()) return a.size() <=> b.size();
  for (std::size_t i = a.size(); i-- > 0;)
    if (a[i] != b[i]) return a[i] <=> b[i];
  return std::strong_ordering::equal;
}

/// Returns how many limbs the sum has. a.size() >= b.size().
inline std::size_t add(Limbs a, Limbs b, Limb* sum) noexcept {
  TwoLimbs carry = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    carry += a[i];
    if (i < b.size()) carry += b[i];
    sum[i] = static_cast<Limb>(carry);
    carry >>= 64;
  }
  if (carry == 0) return a.size();
  sum[a.size()] = static_cast<Limb>(carry);
  return a.size() + 1;
}

/// Returns how many limbs the difference a - b has. a >= b.
inline std::size_t subtract(Limbs a, Limbs b, Limb* difference) noexcept {
  Limb borrow = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const TwoLimbs taken = static_cast<TwoLimbs>(i < b.size() ? b[i] : 0) + borrow;
    borrow = a[i] < taken ? 1 : 0;
    difference[i] = static_cast<Limb>(a[i] - taken);
  }
  return trimmed(difference, a.size());
}

/// Returns how many limbs the product has.
inline std::size_t multiply(Limbs a, Limbs b, Limb* product) noexcept {
  std::fill_n(product, a.size() + b.size(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    Limb carry = 0;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const TwoLimbs sum = static_cast<TwoLimbs>(a[i]) * b[j] + product[i + j] + carry;
      product[i + j] = static_cast<Limb>(sum);
      carry = static_cast<Limb>(sum >> 64);
    }
    product[i + b.size()] = carry;
  }
  return trimmed(product, a.size() + b.size());
}

/// fraction * 2^exponent.
struct Scaled {
  DoubleDouble fraction;
  int exponent = 0;

  double rounded() const noexcept { return std::ldexp(fraction.rounded(), exponent); }
};
inline Scaled operator*(const Scaled& a, const Scaled& b) noexcept {
  return {a.fraction * b.fraction, a.exponent + b.exponent};
}
inline Scaled operator/(const Scaled& a, const Scaled& b) noexcept {
  return {a.fraction / b.fraction, a.exponent - b.exponent};
}

/// A polynomial of this degree in coordinates on a grid.
template <int degree>
class BigInteger {
 public:
  static constexpr std::size_t capacity = std::size_t{34} * degree;  // of 64 bits

  BigInteger() noexcept = default;
  BigInteger(const BigInteger& other) noexcept { assign(other.limbs(), other.negative_); }
  BigInteger& operator=(const BigInteger& other) noexcept {
    assign(other.limbs(), other.negative_);
    return *this;
  }
  template <int lower>
  requires(lower < degree) BigInteger(const BigInteger<lower>& other)
  noexcept { assign(other.limbs(), other.sign() < 0); }
  ~BigInteger() = default;

  static BigInteger one() noexcept { return of(1, 0, false); }
  /// mantissa * 2^shift, or minus that.
  static BigInteger of(Limb mantissa, unsigned shift, bool negative) noexcept {
    BigInteger result;
    const std::size_t whole = shift / 64;
    const unsigned rest = shift % 64;
    std::fill_n(result.limbs_.begin(), whole, 0);
    result.limbs_[whole] = mantissa << rest;
    result.size_ = whole + 1;
    if (rest > 0 && mantissa >> (64 - rest) != 0) result.limbs_[result.size_++] = mantissa >> (64 - rest);
    result.size_ = trimmed(result.limbs_.data(), result.size_);
    result.negative_ = negative;
    return result;
  }

  int sign() const noexcept { return size_ == 0 ? 0 : negative_ ? -1 : 1; }
  Limbs limbs() const noexcept { return {limbs_.data(), size_}; }
  BigInteger operator-() const noexcept {
    BigInteger result = *this;
    result.negative_ = !negative_;
    return result;
  }

  friend BigInteger operator+(const BigInteger& a, const BigInteger& b) noexcept {
    return combined(a, b, b.negative_);
  }
  friend BigInteger operator-(const BigInteger& a, const BigInteger& b) noexcept {
    return combined(a, b, !b.negative_);
  }
  template <int other>
  BigInteger<degree + other> operator*(const BigInteger<other>& b) const noexcept {
    BigInteger<degree + other> product;
    product.set(multiply(limbs(), b.limbs(), product.storage()), (sign() < 0) != (b.sign() < 0));
    return product;
  }
  friend std::strong_ordering operator<=>(const BigInteger& a, const BigInteger& b) noexcept {
    if (a.sign() != b.sign()) return a.sign() <=> b.sign();
    return a.sign() < 0 ? compare(b.limbs(), a.limbs()) : compare(a.limbs(), b.limbs());
  }
  friend bool operator==(const BigInteger& a, const BigInteger& b) noexcept { return (a <=> b) == 0; }

  /// Returns the number to within 2^-104 of it; the fraction is in [1/2, 1], or zero.
  Scaled scaled() const noexcept {
    if (size_ == 0) return {};
    const auto limb = [&](std::size_t from_top) {
      return from_top < size_ ? limbs_[size_ - 1 - from_top] : 0;
    };
    const auto zeros = static_cast<unsigned>(std::countl_zero(limb(0)));
    const auto shifted = [&](std::size_t i) {
      return zeros == 0 ? limb(i) : limb(i) << zeros | limb(i + 1) >> (64 - zeros);
    };
    const Limb top = shifted(0), below = shifted(1);
    const double high = std::ldexp(static_cast<double>(top >> 11), -53);
    const double low = std::ldexp(static_cast<double>(top << 53 | below >> 11), -117);
    const DoubleDouble fraction = two_sum(high, low);
    return {negative_ ? -fraction : fraction, static_cast<int>(64 * size_) - static_cast<int>(zeros)};
  }

  /// Times a plain number, which is not counted as a degree.
  BigInteger times(Limb factor) const noexcept {
    BigInteger product;
    const Limb one_limb[] = {factor};
    product.set(multiply(limbs(), Limbs(one_limb, trimmed(one_limb, 1)), product.storage()), negative_);
    return product;
  }

  /// Storage for a result of the arithmetic of other degrees; set() says what it became.
  Limb* storage() noexcept { return limbs_.data(); }
  void set(std::size_t size, bool negative) noexcept {
    size_ = size;
    negative_ = negative;
  }

 private:
  void assign(Limbs limbs, bool negative) noexcept {
    std::copy(limbs.begin(), limbs.end(), limbs_.begin());
    set(limbs.size(), negative);
  }
  /// a plus the magnitude of b under the sign given.
  static BigInteger combined(const BigInteger& a, const BigInteger& b, bool b_negative) noexcept {
    BigInteger result;
    const bool a_greater = compare(a.limbs(), b.limbs()) >= 0;
    const Limbs greater = a_greater ? a.limbs() : b.limbs(), lesser = a_greater ? b.limbs() : a.limbs();
    const bool negative = a_greater ? a.negative_ : b_negative;
    result.set(a.negative_ == b_negative ? add(greater, lesser, result.storage())
                                         : subtract(greater, lesser, result.storage()),
               negative);
    return result;
  }

  std::array<Limb, capacity> limbs_;
  std::size_t size_ = 0;
  bool negative_ = false;
};

template <int degree>
using Vector = std::array<BigInteger<degree>, 3>;

template <int degree>
Vector<degree> operator-(const Vector<degree>& a, const Vector<degree>& b) noexcept {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <int a_degree, int b_degree>
BigInteger<a_degree + b_degree> dot(const Vector<a_degree>& a, const Vector<b_degree>& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <int a_degree, int b_degree>
Vector<a_degree + b_degree> cross(const Vector<a_degree>& a, const Vector<b_degree>& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <int degree>
Vector<degree> times(const Vector<degree>& v, Limb factor) noexcept {
  return {v[0].times(factor), v[1].times(factor), v[2].times(factor)};
}
template <int degree>
bool is_zero(const Vector<degree>& v) noexcept {
  return v[0].sign() == 0 && v[1].sign() == 0 && v[2].sign() == 0;
}

}  // namespace touchmark::exact
