#include "bench/trajectories/motion_options.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "bench/support/numbers.h"
#include "bench/support/split.h"

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

struct TimeKey {
  std::string_view name;
  std::optional<int> decimals;
};
constexpr std::array<TimeKey, 5> time_keys{
    {{"time", std::nullopt}, {"time_s", 0}, {"time_ms", 3}, {"time_us", 6}, {"time_ns", 9}}};

/// True if the file's times can be this column, or the sum of it and the one that was chosen before.
bool add_time(ChosenColumns& columns, const ChosenTime& time) {
  if (!columns.time) {
    columns.time = time;
    return true;
  }
  if (columns.time_rest) return false;
  columns.time_rest = time;
  if (time.decimals.value_or(0) == 0) std::swap(columns.time, columns.time_rest);
  if (columns.time->decimals.value_or(0) > 0 || columns.time_rest->decimals.value_or(0) == 0) return false;
  columns.time->decimals = 0;
  return true;
}

/// A number above 0 that has an inverse.
double positive(const char* option, const std::string& text) {
  const std::optional<double> value = support::parse_number(text);
  if (!value || !(*value > 0) || !std::isfinite(*value) || !std::isfinite(1 / *value))
    throw std::invalid_argument(fmt::format("{} \"{}\" is not a finite number above 0", option, text));
  return *value;
}

}  // namespace

ChosenColumns parse_columns(const std::string& text) {
  ChosenColumns columns;
  std::array<std::optional<ColumnChoice>, 3> position;
  for (const std::string_view part : support::split(text, ',')) {
    const std::size_t equals = std::min(part.find('='), part.size());
    const std::string_view key = part.substr(0, equals);
    std::optional<ColumnChoice>* const slot = key == "x"        ? &position[0]
                                              : key == "y"      ? &position[1]
                                              : key == "z"      ? &position[2]
                                              : key == "radius" ? &columns.radius
                                                                : nullptr;
    const auto time =
        std::ranges::find_if(time_keys, [&](const TimeKey& known) { return known.name == key; });
    if (equals == part.size() || (slot == nullptr && time == time_keys.end()))
      refuse_columns(text, fmt::format("\"{}\" is not KEY=COL with a known key", part));
    const ColumnChoice choice = choice_of(text, std::string(part.substr(equals + 1)));
    if (slot != nullptr ? slot->has_value() : !add_time(columns, {choice, time->decimals}))
      refuse_columns(text, fmt::format("\"{}\" is one {} too many", part, key));
    if (slot != nullptr) *slot = choice;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!position[axis]) refuse_columns(text, fmt::format("{} is missing", "xyz"[axis]));
    columns.position[axis] = *position[axis];
  }
  return columns;
}

MotionOptions parse_motion_options(const std::string& columns, const std::string& scale,
                                   const std::string& rate, const std::string& drape) {
  MotionOptions options;
  if (!columns.empty()) options.columns = parse_columns(columns);
  if (!scale.empty()) options.scale = positive("--motion-scale", scale);
  if (!rate.empty()) options.rate_hz = positive("--rate", rate);
  if (drape.empty()) return options;
  if (drape != "contact" && drape != "free")
    throw std::invalid_argument(fmt::format("--drape \"{}\" is neither contact nor free", drape));
  options.drape = drape == "free" ? Drape::free : Drape::contact;
  return options;
}

}  // namespace touchmark::bench::trajectories
