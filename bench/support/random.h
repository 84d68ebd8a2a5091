/// Random numbers that are the same on every machine: the standard fixes mt19937_64's output, but leaves its
/// distributions to each library, so the arithmetic from bits to numbers is ours.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>

#include "core/probe.h"

namespace touchmark::bench::support {

/// Returns a point of the triangle, as uniform as u and v are in [0, 1): the far half of the parallelogram is
/// turned onto it.
inline Vec3 point_in_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double u, double v) {
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return a + u * (b - a) + v * (c - a);
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  /// Uniform in [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + unit() * (high - low); }
  /// Uniform in the cube [-half, half)^3.
  Vec3 point(double half = 1) {
    const double x = between(-half, half), y = between(-half, half), z = between(-half, half);
    return {x, y, z};
  }
  /// Uniform in 0..count-1; the bias of the remainder is below count / 2^64.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(bits_() % count); }
  /// Fisher and Yates, with our own arithmetic: std::shuffle differs between libraries.
  template <class Range>
  void shuffle(Range& range) {
    for (std::size_t i = range.size(); i > 1; --i) std::swap(range[i - 1], range[below(i)]);
  }

  /// Uniform on the unit sphere, by rejection: no sine that libraries round differently.
  Vec3 direction() {
    for (;;) {
      const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
      const Vec3 v(x, y, z);
      const double squared = v.squaredNorm();
      if (squared <= 1 && squared > 0x1p-20) return v / std::sqrt(squared);
    }
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace touchmark::bench::support
