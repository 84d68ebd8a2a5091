/// Just enough double-double arithmetic (106 bits) for a cross product and a quotient: Dekker's and Knuth's
/// error-free transformations. Dekker, "A floating-point technique for extending the available precision"
/// (1971). Finite inputs below 1e290. What it is off by: docs/exactness.md, E7.
#pragma once

#include <cmath>

namespace touchmark {

struct DoubleDouble {
  double high = 0, low = 0;

  double rounded() const noexcept { return high + low; }
};

/// a + b exactly.
inline DoubleDouble two_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a * b exactly, without a fused multiply-add (the portable build has none).
inline DoubleDouble two_product(double a, double b) noexcept {
  constexpr double splitter = 134217729.0;  // 2^27 + 1
  const auto split = [](double x) {
    const double scaled = splitter * x;
    const double high = scaled - (scaled - x);
    return DoubleDouble{high, x - high};
  };
  const double product = a * b;
  const DoubleDouble x = split(a), y = split(b);
  return {product, ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble high = two_sum(a.high, b.high);
  const DoubleDouble low = two_sum(a.low, b.low);
  const DoubleDouble middle = two_sum(high.high, high.low + low.high);
  return two_sum(middle.high, middle.low + low.low);
}

inline DoubleDouble operator-(DoubleDouble a) noexcept { return {-a.high, -a.low}; }
inline DoubleDouble operator-(DoubleDouble a, DoubleDouble b) noexcept { return a + -b; }

inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble product = two_product(a.high, b.high);
  return two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

/// Within 2^-101 of the quotient.
inline DoubleDouble operator/(DoubleDouble a, DoubleDouble b) noexcept {
  const double first = a.high / b.high;
  const DoubleDouble rest = a - b * DoubleDouble{first, 0};
  return two_sum(first, rest.high / b.high);
}

/// One step of Newton's method from the root in double: within 2^-100 of it. 0 of what is not above 0.
inline DoubleDouble square_root(DoubleDouble square) noexcept {
  if (!(square.high > 0)) return {};
  const double first = std::sqrt(square.high);
  const DoubleDouble rest = square - two_product(first, first);
  return two_sum(first, rest.high / (2 * first));
}

}  // namespace touchmark
