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

constexpr std::array<std::string_view, 6> position_prefixes = {"", "p", "pos", "pos_", "position_", "hip_"};
constexpr std::array<std::string_view, 8> segments = {"field_",    "header_", "stamp_",     "pose_",
                                                      "position_", "point_",  "transform_", "translation_"};
constexpr std::array<std::string_view, 17> time_names = {
    "time_s",       "time",         "t",           "t_s",      "time_ms",      "time_us",   "time_ns",
    "t_ms",         "t_us",         "t_ns",        "time_sec", "time_seconds", "timestamp", "timestamp_s",
    "timestamp_ms", "timestamp_us", "timestamp_ns"};
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> times_in_parts{
    {{"sec", "nanosec"}, {"secs", "nsecs"}, {"sec", "nsec"}}};

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

/// Returns where the unit in brackets begins, or the name's size.
std::size_t unit_begin(std::string_view name) {
  if (name.empty() || (name.back() != ']' && name.back() != ')')) return name.size();
  const std::size_t begin = name.rfind(name.back() == ']' ? '[' : '(');
  const bool is_index = begin != name.npos && std::isdigit(static_cast<unsigned char>(name[begin + 1])) != 0;
  return begin == name.npos || begin == 0 || is_index ? name.size() : begin;
}

/// Returns the name as names are compared: "pose_position_x" for "%pose.position X [m]".
std::string plain(std::string_view name) {
  name = trimmed(name);
  const std::string_view marks = "%#/_ ";
  const std::size_t begin = std::min(name.find_first_not_of(marks), name.size());
  name.remove_prefix(begin);
  std::string text = in_small_letters(trimmed(name.substr(0, unit_begin(name))));
  for (char& c : text)
    if (c == ' ' || c == '.' || c == '-' || c == '/') c = '_';
  return text;
}

/// Returns the decimals of the unit of time that a name states, in brackets or at its end.
std::optional<int> decimals_of(std::string_view name) {
  name = trimmed(name);
  const std::size_t bracket = unit_begin(name);
  const std::string text = plain(name);
  const std::string unit = bracket < name.size()
                               ? in_small_letters(name.substr(bracket + 1, name.size() - bracket - 2))
                               : text.substr(text.rfind('_') + 1);
  if (bracket == name.size() && text.find('_') == text.npos) return std::nullopt;
  constexpr std::array<std::pair<int, std::array<std::string_view, 4>>, 4> units{
      {{0, {"s", "sec", "seconds", "secs"}},
       {3, {"ms", "msec", "milliseconds", "millisec"}},
       {6, {"us", "usec", "microseconds", "\xc2\xb5s"}},
       {9, {"ns", "nsec", "nanoseconds", "nanosec"}}}};
  for (const auto& [decimals, names] : units)
    if (std::find(names.begin(), names.end(), unit) != names.end()) return decimals;
  return std::nullopt;
}

bool is_axis(std::string_view name) { return name == "x" || name == "y" || name == "z"; }

/// True for p or t, frames of at most two letters each, and an axis: "tx", "p_x", "p_rs_r_x".
bool is_axis_of_a_frame(std::string_view name, std::string_view axis) {
  if (!is_axis(axis) || !name.ends_with(axis) || (name[0] != 'p' && name[0] != 't')) return false;
  name = name.substr(1, name.size() - 2);
  while (!name.empty()) {
    const std::size_t length = std::min(name.find('_', 1), name.size());
    if (name[0] != '_' || length > 3) return false;
    name.remove_prefix(length);
  }
  return true;
}

/// True if the name is longer than `wanted` by what recorders set before it.
bool is_longer(std::string_view name, std::string_view wanted) {
  for (;;) {
    if (name == wanted || is_axis_of_a_frame(name, wanted)) return true;
    const auto segment = std::find_if(segments.begin(), segments.end(),
                                      [&](std::string_view known) { return name.starts_with(known); });
    if (segment == segments.end()) return false;
    name.remove_prefix(segment->size());
  }
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
          line_, fmt::format("the header names column {} twice: {} is column {}, {} is column {} "
                             "(--columns x=COL,y=COL,z=COL[,time=COL] takes columns by number)",
                             name, shown(found->name), found->index + 1, shown(trimmed(names_[i])), i + 1));
    found = MotionColumn{i, std::string(trimmed(names_[i]))};
  }
  return found;
}

std::optional<MotionColumn> MotionNames::find_plain(std::string_view name) const {
  const auto exact = only(name, [&](std::size_t i) { return trimmed(names_[i]) == name; });
  if (exact) return exact;
  const std::string wanted = plain(name);
  return only(name, [&](std::size_t i) { return !wanted.empty() && plain_[i] == wanted; });
}

std::optional<MotionColumn> MotionNames::find(std::string_view name) const {
  if (const auto found = find_plain(name)) return found;
  const std::string wanted = plain(name);
  return only(name, [&](std::size_t i) { return !wanted.empty() && is_longer(plain_[i], wanted); });
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

TimeColumn MotionNames::time_column(const ChosenTime& choice) const {
  MotionColumn time = column(choice.column);
  std::optional<int> decimals = choice.decimals;
  if (!decimals && time.index < names_.size()) decimals = decimals_of(names_[time.index]);
  return {std::move(time), decimals};
}

std::optional<std::array<MotionColumn, 3>> MotionNames::position_with(const std::string& prefix) const {
  std::array<MotionColumn, 3> position;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto column = find_plain(prefix + "xyz"[axis]);
    if (!column) return std::nullopt;
    position[axis] = *column;
  }
  return position;
}

std::optional<std::array<MotionColumn, 3>> MotionNames::usual_position() const {
  for (const std::string_view prefix : position_prefixes)
    if (const auto position = position_with(std::string(prefix))) return position;
  std::optional<std::array<MotionColumn, 3>> found;
  for (const std::string& name : plain_) {
    if (!is_longer(name, "x")) continue;
    const auto position = position_with(name.substr(0, name.size() - 1));
    if (!position) continue;
    if (found)
      throw file_.error_at(
          line_, fmt::format("the header names two positions: {} is column {}, {} is column {} (--columns "
                             "x=COL,y=COL,z=COL takes one of them)",
                             shown((*found)[0].name), (*found)[0].index + 1, shown((*position)[0].name),
                             (*position)[0].index + 1));
    found = position;
  }
  return found;
}

void MotionNames::find_usual_times(MotionColumns& columns) const {
  for (const std::string_view name : time_names) {
    if (const auto column = find_plain(name)) {
      columns.time = TimeColumn{*column, decimals_of(column->name)};
      return;
    }
  }
  for (const auto& [whole, rest] : times_in_parts) {
    const auto seconds = find(whole), nanoseconds = find(rest);
    if (!seconds || !nanoseconds) continue;
    columns.time = TimeColumn{*seconds, 0};
    columns.time_rest = TimeColumn{*nanoseconds, 9};
    return;
  }
  if (const auto stamp = find("stamp")) columns.time = TimeColumn{*stamp, decimals_of(stamp->name)};
}

std::optional<MotionColumns> MotionNames::usual_columns() const {
  const auto position = usual_position();
  if (!position) return std::nullopt;
  MotionColumns columns;
  columns.position = *position;
  columns.radius = find_plain("radius");
  find_usual_times(columns);
  return columns;
}

}  // namespace touchmark::bench::trajectories
