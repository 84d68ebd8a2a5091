/// Eight floats at a time, in code for processors with AVX2. Four, on every processor, are in lanes.h.
#pragma once

#include "core/simd/target.h"

#if TOUCHMARK_HAS_AVX2
#include <array>
#include <cstddef>
#include <cstdint>

#include <immintrin.h>

namespace touchmark::avx2 {

/// For each mask of eight bits the places of those that are set, a byte each, the lowest first.
inline constexpr std::array<std::uint64_t, 256> places_of_bits = [] {
  std::array<std::uint64_t, 256> table{};
  for (std::size_t bits = 0; bits < table.size(); ++bits)
    for (std::uint64_t place = 0, to = 0; place < 8; ++place)
      if ((bits >> place & 1) != 0) table[bits] |= place << (8 * to++);
  return table;
}();

}  // namespace touchmark::avx2

TOUCHMARK_TARGET("avx2")
namespace touchmark::avx2 {

/// Returns the lanes whose bits are set, one behind another: an index for permutevar8x32.
inline __m256i order_of_kept(unsigned bits) noexcept {
  return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(&places_of_bits[bits])));
}

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
