#include "bench/results/validation/fault.h"

#include <fmt/format.h>

namespace touchmark::bench::results::validation {
namespace {

/// Short, and without line ends or anything else that a terminal would obey.
std::string shown(const std::string& value) {
  constexpr std::size_t longest = 60;
  std::string text;
  for (const char c : value.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    text += byte < 0x20 || byte == 0x7f ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return value.size() > longest ? text + "..." : text;
}

}  // namespace

std::string line_of(const Fault& fault) {
  std::string line = fault.file + ":";
  if (fault.line > 0) line += fmt::format("{}:", fault.line);
  if (!fault.where.empty()) line += fmt::format(" {} \"{}\"", shown(fault.where), shown(fault.value));
  return fmt::format("{} {}", line, fault.wrong);
}

}  // namespace touchmark::bench::results::validation
