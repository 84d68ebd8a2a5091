/// Numbers to text and back without loss, the same in every locale.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

namespace touchmark::bench::support {

/// The whole text as a double ("inf" allowed, "nan" not); nothing when it is anything else or out of range.
inline std::optional<double> parse_number(std::string_view text) noexcept {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value != value) return std::nullopt;
  return value;
}

/// Returns the whole text as a number above 0, or inf. Throws std::invalid_argument naming the option where
/// it is none.
inline double positive_number(const char* option, const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (!value || !(*value > 0))
    throw std::invalid_argument(fmt::format("{} \"{}\" is not a number above 0, or inf", option, text));
  return *value;
}

/// The whole text as a whole number of 0 or more.
inline std::optional<std::uint64_t> parse_count(std::string_view text) noexcept {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// A hash or a checksum as it stands in files: 16 hexadecimal digits.
inline std::string hex(std::uint64_t value) { return fmt::format("{:016x}", value); }
inline bool is_hex(std::string_view text) noexcept {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}
/// The whole text as a hexadecimal number, of any number of digits.
inline std::optional<std::uint64_t> parse_hex(std::string_view text) noexcept {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace touchmark::bench::support
