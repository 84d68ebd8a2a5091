/// What the builders' tests of several triangles at a time share, once an instruction set: rows of four
/// floats become columns, and of the lanes of a register those that a mask keeps are stored one behind
/// another. The namespaces hold the same names, and code that is included in both does the same with four
/// lanes or eight.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/simd/lanes.h"
#include "core/simd/target.h"
#include "core/simd/wide.h"

#if TOUCHMARK_HAS_AVX2
#include <immintrin.h>
#endif

namespace touchmark::grid {
namespace portable {

inline constexpr std::size_t lanes = 4;
inline constexpr unsigned all = 0xf;
using Wide = Lanes;
using Slots [[gnu::vector_size(16)]] = std::uint32_t;
inline Wide square_root(Wide x) noexcept { return simd::sqrt(x); }
using touchmark::to_bits;
inline unsigned bits_above(Wide a, Wide b) noexcept { return to_bits(a > b); }
/// Turns rows of four floats, one a triangle, into columns of one float a triangle.
inline std::array<Wide, 4> columns(const std::array<Lanes, lanes>& rows) noexcept {
  return simd::columns(rows[0], rows[1], rows[2], rows[3]);
}

#include "core/grid_group/direct/wide_rows.inl"

/// The lanes whose bits are set. Storing them writes up to as many values as there are lanes.
class Kept {
 public:
  explicit Kept(unsigned bits) noexcept : bits_(bits) {}
  std::size_t count() const noexcept { return static_cast<std::size_t>(__builtin_popcount(bits_)); }
  void store(float* to, Wide values) const noexcept { store_lanes(to, values); }
  void store(std::uint32_t* to, Slots values) const noexcept { store_lanes(to, values); }

 private:
  // Which are kept no branch predictor knows.
  template <class Number, class Vector>
  void store_lanes(Number* to, Vector values) const noexcept {
    for (std::size_t i = 0; i < lanes; ++i) {
      *to = values[i];
      to += bits_ >> i & 1;
    }
  }

  unsigned bits_;
};

}  // namespace portable

#if TOUCHMARK_HAS_AVX2
TOUCHMARK_TARGET("avx2")
namespace avx2 {

inline constexpr std::size_t lanes = 8;
inline constexpr unsigned all = 0xff;
using touchmark::avx2::Wide, touchmark::avx2::WideBits, touchmark::avx2::square_root,
    touchmark::avx2::to_bits;
using Slots [[gnu::vector_size(32)]] = std::uint32_t;
inline unsigned bits_above(Wide a, Wide b) noexcept { return to_bits(a > b); }
/// Transposes four rows of four in each half.
inline std::array<Wide, 4> columns(Wide a, Wide b, Wide c, Wide d) noexcept {
  const Wide ab_low = _mm256_unpacklo_ps(a, b), ab_high = _mm256_unpackhi_ps(a, b);
  const Wide cd_low = _mm256_unpacklo_ps(c, d), cd_high = _mm256_unpackhi_ps(c, d);
  return {_mm256_shuffle_ps(ab_low, cd_low, 0x44), _mm256_shuffle_ps(ab_low, cd_low, 0xee),
          _mm256_shuffle_ps(ab_high, cd_high, 0x44), _mm256_shuffle_ps(ab_high, cd_high, 0xee)};
}
inline std::array<Wide, 4> columns(const std::array<Lanes, lanes>& rows) noexcept {
  const auto joined = [&rows](std::size_t i) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(rows[i]), rows[i + 4], 1);
  };
  return columns(joined(0), joined(1), joined(2), joined(3));
}

#include "core/grid_group/direct/wide_rows.inl"

/// The lanes whose bits are set. Storing them writes as many values as there are lanes.
class Kept {
 public:
  explicit Kept(unsigned bits) noexcept
      : order_(touchmark::avx2::order_of_kept(bits)),
        count_(static_cast<std::size_t>(__builtin_popcount(bits))) {}
  std::size_t count() const noexcept { return count_; }
  void store(float* to, Wide values) const noexcept {
    _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(values, order_));
  }
  void store(std::uint32_t* to, Slots values) const noexcept {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_permutevar8x32_epi32(reinterpret_cast<__m256i>(values), order_));
  }

 private:
  __m256i order_;
  std::size_t count_;
};

}  // namespace avx2
TOUCHMARK_END_TARGET

TOUCHMARK_TARGET("avx2,avx512f,avx512vl,avx512dq")
namespace avx512 {

inline constexpr std::size_t lanes = 16;
inline constexpr unsigned all = 0xffff;
using Wide [[gnu::vector_size(64)]] = float;
// GCC 12 takes what the unmasked intrinsic leaves undefined for something that is read.
inline Wide square_root(Wide x) noexcept { return _mm512_maskz_sqrt_ps(all, x); }
inline unsigned bits_above(Wide a, Wide b) noexcept { return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ); }
inline std::array<Wide, 4> columns(const std::array<Lanes, lanes>& rows) noexcept {
  const auto joined = [&rows](std::size_t i) {
    const __m512 low = _mm512_insertf32x4(_mm512_castps128_ps512(rows[i]), rows[i + 4], 1);
    return _mm512_insertf32x4(_mm512_insertf32x4(low, rows[i + 8], 2), rows[i + 12], 3);
  };
  const Wide a = joined(0), b = joined(1), c = joined(2), d = joined(3);
  const Wide ab_low = _mm512_maskz_unpacklo_ps(all, a, b), ab_high = _mm512_maskz_unpackhi_ps(all, a, b);
  const Wide cd_low = _mm512_maskz_unpacklo_ps(all, c, d), cd_high = _mm512_maskz_unpackhi_ps(all, c, d);
  return {_mm512_shuffle_ps(ab_low, cd_low, 0x44), _mm512_shuffle_ps(ab_low, cd_low, 0xee),
          _mm512_shuffle_ps(ab_high, cd_high, 0x44), _mm512_shuffle_ps(ab_high, cd_high, 0xee)};
}

#include "core/grid_group/direct/wide_rows.inl"

}  // namespace avx512
TOUCHMARK_END_TARGET
#endif

}  // namespace touchmark::grid
