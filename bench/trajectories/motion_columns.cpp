#include "bench/trajectories/motion_columns.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "bench/trajectories/motion_field.h"

namespace touchmark::bench::trajectories {
namespace {

using Header = std::vector<std::string>;

constexpr std::array<std::string_view, 6> position_prefixes = {"", "p", "pos", "pos_", "position_", "hip_"};
constexpr std::array<std::string_view, 10> time_names = {"time_s",  "time",    "t",    "t_s",  "time_ms",
                                                         "time_us", "time_ns", "t_ms", "t_us", "t_ns"};
constexpr const char* must_name = "it must name x, y and z, or --columns say which they are";

/// As names are compared: without capitals, and with one separator of words.
std::string plain(std::string_view name) {
  std::string text(trimmed(name));
  for (char& c : text) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (c == ' ' || c == '.' || c == '-') c = '_';
  }
  return text;
}

/// The column that is called just so, else the one whose name differs in capitals and the like.
std::optional<MotionColumn> find_column(const support::CsvReader& file, const Header& header,
                                        std::string_view name) {
  const std::string wanted = plain(name);
  std::optional<MotionColumn> found;
  for (const bool exactly : {true, false}) {
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (exactly ? trimmed(header[i]) != name : plain(header[i]) != wanted) continue;
      if (found) throw file.error(fmt::format("the header names column {} twice", name));
      found = MotionColumn{i, std::string(trimmed(header[i]))};
    }
    if (found) return found;
  }
  return found;
}

MotionColumns named_columns(const support::CsvReader& file, const Header& header) {
  for (const std::string_view prefix : position_prefixes) {
    MotionColumns columns;
    std::size_t found = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto column = find_column(file, header, std::string(prefix) + "xyz"[axis]);
      if (!column) continue;
      columns.position[axis] = *column;
      ++found;
    }
    if (found < 3) continue;
    columns.radius = find_column(file, header, "radius");
    for (const std::string_view name : time_names) {
      columns.time = find_column(file, header, name);
      columns.seconds = seconds_of(name);
      if (columns.time) break;
    }
    return columns;
  }
  const std::string names = shown(fmt::format("{}", fmt::join(header, ",")));
  for (const char* name : {"x", "y", "z"}) {
    if (!find_column(file, header, name))
      throw file.error(fmt::format("the header {} has no column {}: {}", names, name, must_name));
  }
  throw file.error(fmt::format("the header {}: {}", names, must_name));
}

/// `header` is empty where the file has none.
MotionColumn chosen_column(const support::CsvReader& file, const Header& header, std::size_t count,
                           const ColumnChoice& choice) {
  if (const std::size_t* const number = std::get_if<std::size_t>(&choice)) {
    if (*number > count)
      throw file.error(fmt::format("--columns: there is no column {} of {}", *number, count));
    const std::size_t index = *number - 1;
    const std::string name = header.empty() ? "" : std::string(trimmed(header[index]));
    const bool can_be_shown = !name.empty() && "'" + name + "'" == shown(name);
    return {index, can_be_shown ? name : std::to_string(*number)};
  }
  const std::string& name = std::get<std::string>(choice);
  const std::optional<MotionColumn> found = find_column(file, header, name);
  if (!found) throw file.error(fmt::format("--columns: the header has no column {}", shown(name)));
  return *found;
}

MotionColumns chosen_columns(const support::CsvReader& file, const Header& header, std::size_t count,
                             const ChosenColumns& chosen) {
  MotionColumns columns;
  for (std::size_t axis = 0; axis < 3; ++axis)
    columns.position[axis] = chosen_column(file, header, count, chosen.position[axis]);
  if (chosen.time) columns.time = chosen_column(file, header, count, *chosen.time);
  if (chosen.radius) columns.radius = chosen_column(file, header, count, *chosen.radius);
  columns.seconds = chosen.seconds;
  return columns;
}

bool needs_no_header(const std::optional<ChosenColumns>& chosen) {
  const auto is_number = [](const ColumnChoice& choice) {
    return std::holds_alternative<std::size_t>(choice);
  };
  return chosen && std::all_of(chosen->position.begin(), chosen->position.end(), is_number) &&
         (!chosen->time || is_number(*chosen->time)) && (!chosen->radius || is_number(*chosen->radius));
}

bool holds_numbers(const Header& row) {
  return std::none_of(row.begin(), row.end(),
                      [](const std::string& field) { return support::has_words(field); });
}

/// The names in a comment, where it has as many as the rows have fields.
Header names_in_comment(const support::CsvReader& file, std::size_t count) {
  const std::string& comment = file.last_comment();
  Header names;
  for (std::size_t begin = 0; begin <= comment.size() && support::has_words(comment);) {
    const std::size_t end = std::min(comment.find(file.separator(), begin), comment.size());
    std::string_view name = trimmed(std::string_view(comment).substr(begin, end - begin));
    if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    names.emplace_back(name);
    begin = end + 1;
  }
  return names.size() == count ? names : Header();
}

}  // namespace

MotionColumns read_motion_header(support::CsvReader& file, const std::optional<ChosenColumns>& chosen,
                                 std::vector<std::string>& first_row) {
  Header header;
  if (!file.next(header)) throw file.error("the file is empty: it needs a header that names x, y and z");
  const std::size_t count = header.size();
  if (holds_numbers(header)) {
    Header names = names_in_comment(file, count);
    if (!names.empty() || needs_no_header(chosen)) {
      first_row = std::move(header);
      header = std::move(names);
    }
  }
  MotionColumns columns = chosen ? chosen_columns(file, header, count, *chosen) : named_columns(file, header);
  columns.count = count;
  return columns;
}

}  // namespace touchmark::bench::trajectories
