/// Denormal numbers, which one library built with -ffast-math can switch off for the whole process.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace touchmark::bench::support {

/// Switches denormal numbers on and says whether they had been off. For the calling thread and those it
/// starts later.
inline bool restore_denormals() noexcept {
#if defined(__SSE2__)
  constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;  // MXCSR, Intel SDM vol. 1, 10.2.3
  const unsigned state = _mm_getcsr();
  _mm_setcsr(state & ~(flush_to_zero | denormals_are_zero));
  return (state & (flush_to_zero | denormals_are_zero)) != 0;
#else
  return false;
#endif
}

}  // namespace touchmark::bench::support
