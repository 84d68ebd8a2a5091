/// Four floats at a time, by the vector extensions of GCC and clang: one register on every machine. The wider
/// vectors of a search are its own (core/sphere_cluster/tree/traversal.h).
#pragma once

#include <algorithm>
#include <cmath>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace touchmark {

using Lanes [[gnu::vector_size(16)]] = float;
/// What a comparison of Lanes gives: all bits of a lane, or none.
using LaneBits [[gnu::vector_size(16)]] = int;

inline Lanes broadcast(float x) noexcept { return Lanes{x, x, x, x}; }

/// Returns true if every lane is greater than its counterpart.
inline bool all_exceed(Lanes values, Lanes limits) noexcept {
  const LaneBits beyond = values > limits;
#ifdef __SSE2__
  return _mm_movemask_ps(reinterpret_cast<__m128>(beyond)) == 0xf;
#else
  return (beyond[0] & beyond[1] & beyond[2] & beyond[3]) != 0;
#endif
}

/// Bit i of the result is set when lane i is at most the limit.
inline unsigned at_most(Lanes values, float limit) noexcept {
  const LaneBits below = values <= limit;
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(below)));
#else
  return static_cast<unsigned>((below[0] & 1) | (below[1] & 2) | (below[2] & 4) | (below[3] & 8));
#endif
}

/// Lane by lane, in a namespace of their own so that members called min and max do not hide them.
namespace simd {

inline Lanes max(Lanes a, Lanes b) noexcept { return a > b ? a : b; }
inline Lanes min(Lanes a, Lanes b) noexcept { return a < b ? a : b; }

inline Lanes sqrt(Lanes a) noexcept {
#ifdef __SSE2__
  return reinterpret_cast<Lanes>(_mm_sqrt_ps(reinterpret_cast<__m128>(a)));
#else
  return Lanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}

/// Returns the least of the four.
inline float reduce_min(Lanes a) noexcept { return std::min(std::min(a[0], a[1]), std::min(a[2], a[3])); }
/// Returns the greatest of the four.
inline float reduce_max(Lanes a) noexcept { return std::max(std::max(a[0], a[1]), std::max(a[2], a[3])); }

}  // namespace simd
}  // namespace touchmark
