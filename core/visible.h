#pragma once

/// Makes an exception one type in a shared library and in a program that is compiled with hidden visibility,
/// for any C++ library. Without it, libc++ does not catch there what the library throws.
#if defined(_WIN32)
#define TOUCHMARK_VISIBLE
#else
#define TOUCHMARK_VISIBLE __attribute__((visibility("default")))
#endif
