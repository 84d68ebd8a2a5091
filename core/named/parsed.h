/// Numbers read from texts, the same in every locale.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace touchmark::named {

/// Returns the whole text as a number, or nothing where it is none or out of range. `base` is a whole
/// number's base, and none is 10.
template <class Number, class... Base>
std::optional<Number> parsed(std::string_view text, Base... base) noexcept {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number, base...);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return number;
}

}  // namespace touchmark::named
