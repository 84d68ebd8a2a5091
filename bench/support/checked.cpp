#include "bench/support/checked.h"

#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "bench/support/numbers.h"

namespace touchmark::bench::support {

std::invalid_argument bad_value(std::string_view option, std::string_view value, std::string_view expected) {
  return std::invalid_argument(fmt::format("{} \"{}\" is not {}", option, value, expected));
}

std::uint64_t checked_count(std::string_view option, std::string_view text, std::uint64_t least,
                            std::uint64_t most) {
  const std::optional<std::uint64_t> count = parse_count(text);
  if (!count || *count < least || *count > most)
    throw bad_value(option, text, fmt::format("a whole number from {} to {}", least, most));
  return *count;
}

std::uint64_t count_or(std::uint64_t otherwise, std::string_view option, std::string_view text,
                       std::uint64_t least, std::uint64_t most) {
  return text.empty() ? otherwise : checked_count(option, text, least, most);
}

std::uint64_t checked_seed(std::string_view text) {
  return checked_count("--seed", text, 0, std::numeric_limits<std::uint64_t>::max());
}

double checked_number(std::string_view option, std::string_view text, Zero zero, double most) {
  const std::optional<double> number = parse_number(text);
  const bool zero_too = zero == Zero::allowed;
  if (!number || !(*number > 0 || (zero_too && *number == 0)) || *number > most)
    throw bad_value(option, text,
                    fmt::format("a number {} and at most {:g}", zero_too ? "of 0 or more" : "above 0", most));
  return *number;
}

double checked_positive(std::string_view option, std::string_view text, Infinity infinity) {
  const std::optional<double> number = parse_number(text);
  const bool finite = infinity == Infinity::refused;
  if (!number || !(*number > 0) || (finite && std::isinf(*number)))
    throw bad_value(option, text, finite ? "a number above 0" : "a number above 0, or inf");
  return *number;
}

Length checked_length(std::string_view option, std::string_view text, Infinity infinity) {
  const std::optional<Length> length = parse_length(text);
  const bool finite = infinity == Infinity::refused;
  if (!length || (finite && std::isinf(length->value)))
    throw bad_value(
        option, text,
        fmt::format("a {}length: 0 or more in mesh units, or in percent of the box diagonal, as 0.5%",
                    finite ? "finite " : ""));
  return *length;
}

}  // namespace touchmark::bench::support
