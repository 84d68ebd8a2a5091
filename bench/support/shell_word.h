/// Words of command lines that are printed for the reader to run.
#pragma once

#include <string>
#include <string_view>

namespace touchmark::bench::support {

/// Returns the text as one word for a shell: in quotes where it needs them.
inline std::string quoted(const std::string& word) {
  constexpr std::string_view harmless =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./:,=+@%";
  if (!word.empty() && word.find_first_not_of(harmless) == std::string::npos) return word;
  std::string text = "'";
  for (const char character : word) text += character == '\'' ? "'\\''" : std::string(1, character);
  return text + '\'';
}

}  // namespace touchmark::bench::support
