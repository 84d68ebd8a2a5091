/// What a program that includes these headers must be compiled with: C++20, and arithmetic as IEEE 754 has
/// it. Installing puts this first into every header, so that its line is the first error. Whether products
/// and sums are fused (-ffp-contract, on with GCC's -march=native) does not matter: no inline function here
/// rounds where it shows.
#pragma once

#if __cplusplus < 202002L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 202002L)
#error "touchmark needs C++20"
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(_M_FP_FAST)
#error "touchmark needs IEEE 754 arithmetic: compile without -ffast-math, -Ofast and their parts"
#endif
