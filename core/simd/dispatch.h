/// The processor's vector instructions that a search may use. All give the same bits and the same work
/// counts.
#pragma once

namespace touchmark {

enum class Simd {
  portable,  ///< what every processor of its kind has: SSE2 on x86-64, NEON on 64-bit ARM
  avx2,
  avx512  ///< with its VL and DQ parts; the vectors stay 256 bits wide
};

/// Returns the widest of this processor, of those that the build has code for.
Simd widest_simd() noexcept;

/// True where that is AVX2 or more. What runs before the library's objects are initialized may find it false,
/// which changes no answer.
extern const bool has_avx2;

}  // namespace touchmark
