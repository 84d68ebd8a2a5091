/// Four floats at a time, by the vector extensions of GCC and clang: one register on every machine. The wider
/// vectors of a search are its own (core/bvh/traversal.h).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace touchmark {

using Lanes [[gnu::vector_size(16)]] = float;
/// What a comparison of Lanes gives: all bits of a lane, or none.
using LaneBits [[gnu::vector_size(16)]] = int;

inline Lanes broadcast(float x) noexcept { return Lanes{x, x, x, x}; }
/// Reads four floats, which need not be aligned.
inline Lanes load(const float* from) noexcept {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

/// Bit i of the result is set when lane i is.
inline unsigned to_bits(LaneBits lanes) noexcept {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(lanes)));
#elif defined(__aarch64__)
  return vaddvq_u32(reinterpret_cast<uint32x4_t>(lanes & LaneBits{1, 2, 4, 8}));
#else
  return static_cast<unsigned>((lanes[0] & 1) | (lanes[1] & 2) | (lanes[2] & 4) | (lanes[3] & 8));
#endif
}

/// Returns true if every lane is greater than its counterpart.
inline bool all_exceed(Lanes values, Lanes limits) noexcept { return to_bits(values > limits) == 0xf; }

/// Bit i of the result is set when lane i is at most the limit.
inline unsigned at_most(Lanes values, float limit) noexcept { return to_bits(values <= limit); }

/// Lane by lane, in a namespace of their own so that members called min and max do not hide them.
namespace simd {

inline Lanes max(Lanes a, Lanes b) noexcept { return a > b ? a : b; }
inline Lanes min(Lanes a, Lanes b) noexcept { return a < b ? a : b; }

inline Lanes sqrt(Lanes a) noexcept {
#if defined(__SSE2__)
  return reinterpret_cast<Lanes>(_mm_sqrt_ps(reinterpret_cast<__m128>(a)));
#elif defined(__aarch64__)
  return reinterpret_cast<Lanes>(vsqrtq_f32(reinterpret_cast<float32x4_t>(a)));
#else
  return Lanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}

/// Transposes four rows of four.
inline std::array<Lanes, 4> columns(Lanes a, Lanes b, Lanes c, Lanes d) noexcept {
  const Lanes ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const Lanes ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Lanes cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Lanes cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {__builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5),
          __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7),
          __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5),
          __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7)};
}

/// Returns the least of the four.
inline float reduce_min(Lanes a) noexcept { return std::min(std::min(a[0], a[1]), std::min(a[2], a[3])); }
/// Returns the greatest of the four.
inline float reduce_max(Lanes a) noexcept { return std::max(std::max(a[0], a[1]), std::max(a[2], a[3])); }

}  // namespace simd
}  // namespace touchmark
