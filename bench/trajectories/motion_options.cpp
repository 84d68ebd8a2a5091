#include "bench/trajectories/motion_options.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

#include "bench/support/numbers.h"

namespace touchmark::bench::trajectories {
namespace {

[[noreturn]] void refuse_columns(const std::string& text, const std::string& why) {
  throw std::invalid_argument(fmt::format(
      "--columns \"{}\": {}; write x=COL,y=COL,z=COL[,time=COL][,radius=COL], COL a name or a number from 1",
      text, why));
}

ColumnChoice choice_of(const std::string& text, const std::string& column) {
  if (column.empty()) refuse_columns(text, "a column is empty");
  const std::optional<std::uint64_t> number = support::parse_count(column);
  if (!number) return column;
  if (*number == 0) refuse_columns(text, "columns are counted from 1");
  return static_cast<std::size_t>(*number);
}

bool is_time(std::string_view key) {
  return key == "time" || key == "time_s" || key == "time_ms" || key == "time_us" || key == "time_ns";
}

/// A number above 0 that has an inverse.
double positive(const char* option, const std::string& text) {
  const std::optional<double> value = support::parse_number(text);
  if (!value || !(*value > 0) || !std::isfinite(*value) || !std::isfinite(1 / *value))
    throw std::invalid_argument(fmt::format("{} \"{}\" is not a finite number above 0", option, text));
  return *value;
}

}  // namespace

double seconds_of(std::string_view column) noexcept {
  if (column.ends_with("_ms")) return 1e-3;
  if (column.ends_with("_us")) return 1e-6;
  return column.ends_with("_ns") ? 1e-9 : 1;
}

ChosenColumns parse_columns(const std::string& text) {
  ChosenColumns columns;
  std::array<std::optional<ColumnChoice>, 3> position;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t equals = std::min(part.find('='), part.size());
    const std::string key = part.substr(0, equals);
    std::optional<ColumnChoice>* const slot = key == "x"        ? &position[0]
                                              : key == "y"      ? &position[1]
                                              : key == "z"      ? &position[2]
                                              : key == "radius" ? &columns.radius
                                              : is_time(key)    ? &columns.time
                                                                : nullptr;
    if (equals == part.size() || slot == nullptr)
      refuse_columns(text, fmt::format("\"{}\" is not KEY=COL with a known key", part));
    if (*slot) refuse_columns(text, fmt::format("\"{}\" is one {} too many", part, key));
    *slot = choice_of(text, part.substr(equals + 1));
    if (is_time(key)) columns.seconds = seconds_of(key);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!position[axis]) refuse_columns(text, fmt::format("{} is missing", "xyz"[axis]));
    columns.position[axis] = *position[axis];
  }
  return columns;
}

MotionOptions parse_motion_options(const std::string& columns, const std::string& scale,
                                   const std::string& rate) {
  MotionOptions options;
  if (!columns.empty()) options.columns = parse_columns(columns);
  if (!scale.empty()) options.scale = positive("--motion-scale", scale);
  if (!rate.empty()) options.rate_hz = positive("--rate", rate);
  return options;
}

}  // namespace touchmark::bench::trajectories
