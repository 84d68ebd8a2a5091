/// A small file as a whole.
#pragma once

#include <cstddef>
#include <string>

namespace touchmark::bench::support {

inline constexpr std::size_t largest_text_file = std::size_t{1} << 30;

/// Throws std::invalid_argument when there is no such file, it cannot be read, or it is larger than
/// `largest_text_file`.
std::string read_text_file(const std::string& path);

}  // namespace touchmark::bench::support
