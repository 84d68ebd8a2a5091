/// Values of options. Each function throws std::invalid_argument that names the option, the value and what it
/// is not.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "bench/support/length.h"

namespace touchmark::bench::support {

/// Returns the error that says `OPTION "VALUE" is not EXPECTED`.
std::invalid_argument bad_value(std::string_view option, std::string_view value, std::string_view expected);

/// Returns a whole number from `least` to `most`.
std::uint64_t checked_count(std::string_view option, std::string_view text, std::uint64_t least,
                            std::uint64_t most);
/// Returns `otherwise` for an empty text.
std::uint64_t count_or(std::uint64_t otherwise, std::string_view option, std::string_view text,
                       std::uint64_t least, std::uint64_t most);
/// Returns a whole number of at most 64 bits.
std::uint64_t checked_seed(std::string_view text);

enum class Zero { allowed, refused };
/// Returns a number above 0, or 0 where it is allowed, and at most `most`.
double checked_number(std::string_view option, std::string_view text, Zero zero, double most);

enum class Infinity { allowed, refused };
/// Returns a number above 0.
double checked_positive(std::string_view option, std::string_view text,
                        Infinity infinity = Infinity::refused);

/// Returns a length of 0 or more.
Length checked_length(std::string_view option, std::string_view text, Infinity infinity = Infinity::refused);

}  // namespace touchmark::bench::support
