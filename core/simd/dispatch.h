/// The processor's vector instructions that a search may use. All give the same bits and the same work
/// counts.
#pragma once

#include <algorithm>

namespace touchmark {

enum class Simd {
  portable,  ///< what every x86-64 has, or plain C++ elsewhere
  avx2,
  avx512  ///< with its VL and DQ parts; the vectors stay 256 bits wide
};

/// Returns true if the processor has AVX2, whatever the build has code for.
inline bool has_avx2() noexcept {
#if defined(__x86_64__) && defined(__GNUC__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

/// The widest of this processor, of those that the build has code for.
inline Simd widest_simd() noexcept {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (!has_avx2()) return Simd::portable;
  const bool avx512 = __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
                      __builtin_cpu_supports("avx512dq") != 0;
  return avx512 ? Simd::avx512 : Simd::avx2;
#else
  return Simd::portable;
#endif
}

}  // namespace touchmark
