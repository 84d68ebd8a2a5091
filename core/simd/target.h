/// Code for instructions that not every processor has, in a build for all processors.
#pragma once

/// 1 where the build has code for AVX2 and AVX-512. GCC for Windows has none: it aligns vectors of 32 bytes
/// on the stack to 16 bytes only, and stores them as if they were aligned (GCC bug 54412).
#if defined(__x86_64__) && defined(__GNUC__) && (defined(__clang__) || !defined(_WIN32))
#define TOUCHMARK_HAS_AVX2 1
#else
#define TOUCHMARK_HAS_AVX2 0
#endif

/// The functions between TOUCHMARK_TARGET("avx2") and TOUCHMARK_END_TARGET are compiled for AVX2.
#define TOUCHMARK_PRAGMA(...) _Pragma(#__VA_ARGS__)
#ifdef __clang__
#define TOUCHMARK_TARGET(instructions) \
  TOUCHMARK_PRAGMA(clang attribute push(__attribute__((target(instructions))), apply_to = function))
#define TOUCHMARK_END_TARGET TOUCHMARK_PRAGMA(clang attribute pop)
#else
#define TOUCHMARK_TARGET(instructions) \
  TOUCHMARK_PRAGMA(GCC push_options) TOUCHMARK_PRAGMA(GCC target(instructions))
#define TOUCHMARK_END_TARGET TOUCHMARK_PRAGMA(GCC pop_options)
#endif
