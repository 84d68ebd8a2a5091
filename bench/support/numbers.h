/// Numbers to text and back without loss, the same in every locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/named/parsed.h"

namespace touchmark::bench::support {

/// The whole text as a double ("inf" allowed, "nan" not); nothing when it is anything else or out of range.
inline std::optional<double> parse_number(std::string_view text) noexcept {
  const std::optional<double> value = named::parsed<double>(text);
  return value && *value == *value ? value : std::nullopt;
}

/// The whole text as a whole number of 0 or more.
inline std::optional<std::uint64_t> parse_count(std::string_view text) noexcept {
  return named::parsed<std::uint64_t>(text);
}

/// A hash or a checksum as it stands in files: 16 hexadecimal digits.
inline std::string hex(std::uint64_t value) { return fmt::format("{:016x}", value); }
inline bool is_hex(std::string_view text) noexcept {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}
/// The whole text as a hexadecimal number, of any number of digits.
inline std::optional<std::uint64_t> parse_hex(std::string_view text) noexcept {
  return named::parsed<std::uint64_t>(text, 16);
}

}  // namespace touchmark::bench::support
