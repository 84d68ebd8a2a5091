#include "bench/trajectories/motion_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "bench/trajectories/motion_field.h"

namespace touchmark::bench::trajectories {
namespace {

constexpr std::array<std::string_view, 10> position_prefixes = {"",     "p", "pos", "pos_", "position_",
                                                                "hip_", "t", "p_",  "t_",   "p_rs_r_"};
constexpr std::array<std::string_view, 16> time_names = {
    "time_s", "time", "t",         "t_s",         "time_ms",      "time_us",      "time_ns",      "t_ms",
    "t_us",   "t_ns", "timestamp", "timestamp_s", "timestamp_ms", "timestamp_us", "timestamp_ns", "stamp"};
/// What recorders set before the names of parts.
constexpr std::array<std::string_view, 8> wholes = {"field_",    "header_", "stamp_",     "pose_",
                                                    "position_", "point_",  "transform_", "translation_"};

/// Returns where the unit in brackets begins, or the name's size.
std::size_t unit_begin(std::string_view name) {
  if (!name.ends_with(']') && !name.ends_with(')')) return name.size();
  const std::size_t begin = name.rfind(name.back() == ']' ? '[' : '(');
  const bool is_index = begin != name.npos && std::isdigit(static_cast<unsigned char>(name[begin + 1])) != 0;
  return begin == name.npos || begin == 0 || is_index ? name.size() : begin;
}

/// Returns the name as names are compared: "pose_position_x" for "%pose.position X [m]".
std::string plain(std::string_view name) {
  name.remove_prefix(std::min(name.find_first_not_of("%#/_ \t"), name.size()));
  name = trimmed(name);
  std::string text(trimmed(name.substr(0, unit_begin(name))));
  for (char& c : text) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (c == ' ' || c == '.' || c == '-' || c == '/') c = '_';
  }
  return text;
}

struct TimeUnit {
  std::string_view name;
  int decimals;
};
constexpr std::array<TimeUnit, 23> time_units = {
    {{"s", 0},       {"sec", 0},         {"secs", 0},         {"second", 0},
     {"seconds", 0}, {"ms", 3},          {"msec", 3},         {"msecs", 3},
     {"millis", 3},  {"millisecond", 3}, {"milliseconds", 3}, {"us", 6},
     {"\u00b5s", 6}, {"\u03bcs", 6},     {"usec", 6},         {"usecs", 6},
     {"micros", 6},  {"microsecond", 6}, {"microseconds", 6}, {"ns", 9},
     {"nsec", 9},    {"nanosecond", 9},  {"nanoseconds", 9}}};

/// Returns the unit of time, in brackets behind a name.
std::string_view bracketed_unit(std::string_view name) {
  name = trimmed(name);
  const std::size_t bracket = unit_begin(name);
  return bracket < name.size() ? trimmed(name.substr(bracket + 1, name.size() - bracket - 2)) : "";
}

std::optional<int> decimals_of_unit(std::string_view unit) {
  const std::string wanted = plain(unit);
  const auto found = std::ranges::find(time_units, wanted, &TimeUnit::name);
  return found == time_units.end() ? std::nullopt : std::optional(found->decimals);
}

/// Returns the decimals of the unit at the end of a name, as in "time_ms".
std::optional<int> decimals_of_end(std::string_view name) {
  const std::string text = plain(name);
  const std::size_t mark = text.rfind('_');
  return mark == text.npos ? std::nullopt : decimals_of_unit(std::string_view(text).substr(mark + 1));
}

/// True if `name` is `wanted` with nothing but wholes before it: "field_pose_x" and "pose_x".
bool is_part(std::string_view name, std::string_view wanted) {
  while (name.size() > wanted.size()) {
    const auto whole =
        std::ranges::find_if(wholes, [&](std::string_view known) { return name.starts_with(known); });
    if (whole == wholes.end()) return false;
    name.remove_prefix(whole->size());
  }
  return name == wanted;
}

}  // namespace

MotionNames::MotionNames(const support::CsvReader& file, std::vector<std::string> names, std::size_t line)
    : file_(file), names_(std::move(names)), line_(line) {
  for (const std::string& name : names_) plain_.push_back(plain(name));
}

/// Returns the column whose index fits.
template <class Fits>
std::optional<MotionColumn> MotionNames::only(std::string_view name, const Fits& fits) const {
  std::optional<MotionColumn> found;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (!fits(i)) continue;
    if (found)
      throw file_.error_at(
          line_, fmt::format("the header names column {} twice: {} is column {}, {} is column {} (--columns "
                             "x=COL,y=COL,z=COL[,time=COL] takes columns by number)",
                             name, shown(found->name), found->index + 1, shown(trimmed(names_[i])), i + 1));
    found = MotionColumn{i, std::string(trimmed(names_[i]))};
  }
  return found;
}

std::optional<MotionColumn> MotionNames::find_whole(std::string_view name) const {
  const std::string wanted = plain(name);
  const auto exact = only(name, [&](std::size_t i) { return trimmed(names_[i]) == name; });
  return exact || wanted.empty() ? exact : only(name, [&](std::size_t i) { return plain_[i] == wanted; });
}

std::optional<MotionColumn> MotionNames::find_part(std::string_view name) const {
  const std::string wanted = plain(name);
  return only(name, [&](std::size_t i) { return !wanted.empty() && is_part(plain_[i], wanted); });
}

std::optional<MotionColumn> MotionNames::find(std::string_view name) const {
  const auto whole = find_whole(name);
  return whole ? whole : find_part(name);
}

MotionColumn MotionNames::column(const ColumnChoice& choice) const {
  if (const std::size_t* const number = std::get_if<std::size_t>(&choice)) {
    const std::size_t index = *number - 1;
    const std::string name(index < names_.size() ? trimmed(names_[index]) : "");
    const bool can_be_shown = !name.empty() && "'" + name + "'" == shown(name);
    return {index, can_be_shown ? name : std::to_string(*number)};
  }
  const std::string& name = std::get<std::string>(choice);
  const std::optional<MotionColumn> found = find(name);
  if (!found) throw file_.error_at(line_, fmt::format("--columns: the header has no column {}", shown(name)));
  return *found;
}

/// Returns the decimals of the unit of time that a name states, in brackets or at its end.
std::optional<int> MotionNames::decimals_of(std::string_view name) const {
  const std::string_view unit = bracketed_unit(name);
  const std::optional<int> end = decimals_of_end(name);
  if (unit.empty()) return end;
  const std::optional<int> decimals = decimals_of_unit(unit);
  constexpr const char* way_out =
      "--columns x=COL,y=COL,z=COL,time_ms=COL (or time_s, time_us, time_ns) says it";
  if (!decimals)
    throw file_.error_at(line_, fmt::format("column {}: the unit {} is none of s, ms, us and ns; {}",
                                            shown(trimmed(name)), shown(unit), way_out));
  if (end && end != decimals)
    throw file_.error_at(
        line_, fmt::format("column {}: the name states two units; {}", shown(trimmed(name)), way_out));
  return decimals;
}

TimeColumn MotionNames::time_column(const ChosenTime& choice) const {
  MotionColumn time = column(choice.column);
  std::optional<int> decimals = choice.decimals;
  if (!decimals && time.index < names_.size()) decimals = decimals_of(names_[time.index]);
  return {std::move(time), decimals};
}

std::optional<std::array<MotionColumn, 3>> MotionNames::usual_position() const {
  for (const auto find : {&MotionNames::find_whole, &MotionNames::find_part}) {
    for (const std::string_view prefix : position_prefixes) {
      const auto axis = [&](char letter) { return (this->*find)(std::string(prefix) + letter); };
      const auto before = [&](const MotionColumn& column) {
        return plain_[column.index].substr(0, plain_[column.index].size() - 1);
      };
      const auto x = axis('x'), y = axis('y'), z = axis('z');
      if (x && y && z && before(*x) == before(*y) && before(*x) == before(*z)) return {{*x, *y, *z}};
    }
  }
  return std::nullopt;
}

std::optional<MotionColumns> MotionNames::usual_columns() const {
  const auto position = usual_position();
  if (!position) return std::nullopt;
  MotionColumns columns;
  columns.position = *position;
  columns.radius = find("radius");
  find_usual_times(columns);
  return columns;
}

void MotionNames::find_usual_times(MotionColumns& columns) const {
  for (const std::string_view name : time_names) {
    const auto time = find(name);
    if (!time) continue;
    columns.time = TimeColumn{*time, decimals_of(time->name)};
    return;
  }
  for (const auto& [whole, rest] : {std::pair{"sec", "nanosec"}, {"secs", "nsecs"}}) {
    const auto seconds = find(whole), nanoseconds = find(rest);
    if (!seconds || !nanoseconds) continue;
    columns.time = TimeColumn{*seconds, 0};
    columns.time_rest = TimeColumn{*nanoseconds, 9};
  }
}

}  // namespace touchmark::bench::trajectories
