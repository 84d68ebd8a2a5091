#include "bench/trajectories/motion_field.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include <fmt/format.h>

namespace touchmark::bench::trajectories {

std::string shown(std::string_view text) {
  std::string begin(text.substr(0, 40));
  for (char& c : begin)
    if (std::isprint(static_cast<unsigned char>(c)) == 0) c = '?';
  return "'" + begin + (text.size() > 40 ? "..." : "") + "'";
}

std::string no_number(std::string_view field, char separator) {
  const bool comma = field.find(',') != field.npos && separator == ',';
  return fmt::format("{} is not a number{}", shown(trimmed(field)),
                     comma ? " (decimal commas need ; or tabs between columns)" : "");
}

double NumberReader::read(const std::string& field, const std::string& column) {
  const auto wrong = [&](const std::string& why) {
    return file_.error(fmt::format("column {}: {}{}", column, shown(trimmed(field)), why));
  };
  const std::string_view text = trimmed(field);
  const std::size_t mark = text.find_first_of(".,");
  if (mark != text.npos && (text[mark] == '.' || file_.separator() != ',')) {
    if (decimal_ != 0 && decimal_ != text[mark])
      throw wrong(text[mark] == ',' ? " has a decimal comma, numbers above a decimal point"
                                    : " has a decimal point, numbers above a decimal comma");
    decimal_ = text[mark];
  }
  double value = 0;
  const std::errc failure = support::parse_decimal(text, file_.separator(), value);
  if (failure == std::errc::result_out_of_range) throw wrong(" is beyond the range of a double");
  if (failure != std::errc())
    throw file_.error(fmt::format("column {}: {}", column, no_number(field, file_.separator())));
  if (!std::isfinite(value)) throw wrong(" is not finite");
  return value;
}

std::optional<int> decimals_of_date(double value) noexcept {
  constexpr double year_1990 = 631'152'000, year_2100 = 4'102'444'800;  // in seconds
  for (const int decimals : {0, 3, 6, 9}) {
    if (value >= year_1990 && value < year_2100) return decimals;
    value /= 1000;
  }
  return std::nullopt;
}

std::int64_t nanoseconds_of(std::string_view number, int decimals) {
  number = trimmed(number);
  if (number.starts_with('+')) number.remove_prefix(1);
  const std::size_t mark = std::min(number.find_first_of("eE"), number.size());
  std::string digits(number.substr(0, mark));
  long places = 9 - decimals;
  if (mark < number.size()) {
    const std::size_t power = mark + (number.substr(mark + 1).starts_with('+') ? 2 : 1);
    long exponent = 0;
    std::from_chars(number.data() + power, number.data() + number.size(), exponent);
    places += exponent;
  }
  const std::size_t point = std::min(digits.find_first_of(".,"), digits.size());
  if (point < digits.size()) digits.erase(point, 1);
  const long most = static_cast<long>(digits.size()) + 19;  // more only if all are 0
  digits.resize(static_cast<std::size_t>(std::clamp(static_cast<long>(point) + places, 0L, most)), '0');
  std::int64_t nanoseconds = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), nanoseconds);
  return nanoseconds;
}

}  // namespace touchmark::bench::trajectories
