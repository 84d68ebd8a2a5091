/// Eight floats at a time, in code for processors with AVX2. Four, on every processor, are in lanes.h.
#pragma once

#include "core/simd/target.h"

#if TOUCHMARK_HAS_AVX2
#include <immintrin.h>

TOUCHMARK_TARGET("avx2")
namespace touchmark::avx2 {

using Wide [[gnu::vector_size(32)]] = float;
/// What a comparison of Wide gives: all bits of a lane, or none.
using WideBits [[gnu::vector_size(32)]] = int;

inline Wide square_root(Wide x) noexcept { return _mm256_sqrt_ps(x); }
/// Bit i of the result is set when lane i is.
inline unsigned to_bits(WideBits lanes) noexcept {
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(lanes)));
}

}  // namespace touchmark::avx2
TOUCHMARK_END_TARGET
#endif
