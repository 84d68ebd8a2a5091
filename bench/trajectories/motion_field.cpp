#include "bench/trajectories/motion_field.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

namespace touchmark::bench::trajectories {

std::string_view trimmed(std::string_view text) noexcept {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string shown(std::string_view text) {
  std::string begin(text.substr(0, 40));
  for (char& c : begin)
    if (std::isprint(static_cast<unsigned char>(c)) == 0) c = '?';
  return "'" + begin + (text.size() > 40 ? "..." : "") + "'";
}

double NumberReader::read(const std::string& field, const std::string& column) {
  const auto wrong = [&](const std::string& why) {
    return file_.error(fmt::format("column {}: {}{}", column, shown(trimmed(field)), why));
  };
  std::string text(trimmed(field));
  const std::size_t mark = text.find_first_of(".,");
  if (mark != text.npos && (text[mark] == '.' || file_.separator() != ',')) {
    const char decimal = text[mark];
    if (decimal_ != 0 && decimal_ != decimal)
      throw wrong(decimal == ',' ? " has a decimal comma, numbers above a decimal point"
                                 : " has a decimal point, numbers above a decimal comma");
    decimal_ = decimal;
    text[mark] = '.';
  }
  double value = 0;
  const char* const begin = text.data() + (text.starts_with('+') && !text.starts_with("+-") ? 1 : 0);
  const char* const end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(begin, end, value);
  if (failure == std::errc::result_out_of_range && stop == end)
    throw wrong(" is beyond the range of a double");
  if (failure != std::errc() || stop != end) {
    const bool comma = text.find(',') != text.npos && file_.separator() == ',';
    throw wrong(comma ? " is not a number (decimal commas need ; or tabs between columns)"
                      : " is not a number");
  }
  if (!std::isfinite(value)) throw wrong(" is not finite");
  return value;
}

}  // namespace touchmark::bench::trajectories
