/// Directions on the circle without the C library's sine and cosine, whose last bits differ from one to the
/// next.
#pragma once

#include <cmath>

namespace touchmark::bench::meshes {

struct SinCos {
  double cos = 1, sin = 0;
};

/// The direction at `fraction` of a full turn, within about one rounding. Any finite fraction.
inline SinCos portable_sincos(double fraction) noexcept {
  constexpr double full_turn = 6.283185307179586476925;
  const double quarters = std::nearbyint(4 * fraction);
  const double angle =
      full_turn * (fraction - quarters / 4);  // within an eighth of a turn: the series converge fast
  const double square = angle * angle;
  double cosine = 1, sine = 1;  // Taylor's series in Horner's form
  for (int n = 18; n >= 2; n -= 2) {
    cosine = 1 - square / (n * (n - 1)) * cosine;
    sine = 1 - square / (n * (n + 1)) * sine;
  }
  sine *= angle;
  switch (static_cast<long long>(quarters) & 3) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace touchmark::bench::meshes
