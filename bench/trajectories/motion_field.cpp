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

Instant instant_of(std::string_view number, int decimals) {
  constexpr std::size_t places = 18;      // of attoseconds
  constexpr long max_exponent = 100'000;  // only of a zero
  number = trimmed(number);
  const std::size_t mark = std::min(number.find_first_of("eE"), number.size());
  long exponent = 0;
  if (mark < number.size()) {
    std::string_view power = number.substr(mark + 1);
    if (power.starts_with('+')) power.remove_prefix(1);
    const auto failure = std::from_chars(power.data(), power.data() + power.size(), exponent).ec;
    if (failure == std::errc::result_out_of_range) exponent = 0;
    exponent = std::clamp(exponent, -max_exponent, max_exponent);
  }
  std::string digits;
  std::optional<std::size_t> point;
  for (const char c : number.substr(0, mark)) {
    if (c >= '0' && c <= '9') digits.push_back(c);
    if (c == '.' || c == ',') point = digits.size();
  }
  const long before = static_cast<long>(point.value_or(digits.size())) + exponent - decimals;
  if (before < 0) digits.insert(0, static_cast<std::size_t>(-before), '0');
  const auto whole = static_cast<std::size_t>(std::max(before, 0L));
  digits.resize(std::max(digits.size(), whole) + places, '0');
  Instant instant;
  std::from_chars(digits.data(), digits.data() + whole, instant.whole_s);
  std::from_chars(digits.data() + whole, digits.data() + whole + places, instant.attoseconds);
  return number.starts_with('-') ? Instant{-instant.whole_s, -instant.attoseconds} : instant;
}

double seconds_between(const Instant& start, const Instant& end) {
  constexpr std::int64_t second = 1'000'000'000'000'000'000;
  double whole = end.whole_s - start.whole_s;
  std::int64_t rest = end.attoseconds - start.attoseconds;  // of less than 2 s
  if (whole > 0 && rest < 0) {
    whole -= 1;
    rest += second;
  } else if (whole < 0 && rest > 0) {
    whole += 1;
    rest -= second;
  }
  return whole + static_cast<double>(rest) / static_cast<double>(second);
}

}  // namespace touchmark::bench::trajectories
