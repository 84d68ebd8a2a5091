/// Asks for memory before it is read.
#pragma once

#include <cstddef>

namespace touchmark {

/// Asks for so many bytes, a cache line at a time.
inline void prefetch_lines(const void* start, std::size_t size) noexcept {
  constexpr std::size_t line = 64;
  for (std::size_t at = 0; at < size; at += line) __builtin_prefetch(static_cast<const char*>(start) + at);
}

}  // namespace touchmark
