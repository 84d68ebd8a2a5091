#include "core/simd/dispatch.h"

#include "core/simd/target.h"

namespace touchmark {

Simd widest_simd() noexcept {
#if TOUCHMARK_HAS_AVX2
  if (__builtin_cpu_supports("avx2") == 0) return Simd::portable;
  const bool avx512 = __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
                      __builtin_cpu_supports("avx512dq") != 0;
  return avx512 ? Simd::avx512 : Simd::avx2;
#else
  return Simd::portable;
#endif
}

const bool has_avx2 = widest_simd() >= Simd::avx2;

}  // namespace touchmark
