#include "bench/trajectory_csv.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "bench/atomic_file.h"
#include "bench/available_memory.h"
#include "bench/csv_reader.h"

namespace touchmark::bench {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Which field of a row holds what.
struct Columns {
  std::array<std::size_t, 3> position{};
  std::optional<std::size_t> radius, time;
  std::size_t count = 0;
};

std::optional<std::size_t> find_column(const CsvReader& file, const std::vector<std::string>& header,
                                       std::string_view name) {
  const auto is_named = [&](const std::string& field) { return trimmed(field) == name; };
  const auto found = std::find_if(header.begin(), header.end(), is_named);
  if (found == header.end()) return std::nullopt;
  if (std::find_if(found + 1, header.end(), is_named) != header.end())
    throw file.error("the header names column " + std::string(name) + " twice");
  return static_cast<std::size_t>(found - header.begin());
}

Columns read_header(CsvReader& file) {
  std::vector<std::string> header;
  if (!file.next(header)) throw file.error("the file is empty: it needs a header that names x, y and z");
  Columns columns;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string_view name = std::string_view("xyz").substr(axis, 1);
    const auto column = find_column(file, header, name);
    if (!column)
      throw file.error("the header has no column " + std::string(name) + ": it must name x, y and z");
    columns.position[axis] = *column;
  }
  columns.radius = find_column(file, header, "radius");
  columns.time = find_column(file, header, "time_s");
  columns.count = header.size();
  return columns;
}

/// What a message shows of a field: enough to recognise it, and nothing that a terminal would obey.
std::string shown(std::string_view text) {
  std::string begin(text.substr(0, 40));
  for (char& c : begin)
    if (std::isprint(static_cast<unsigned char>(c)) == 0) c = '?';
  return "'" + begin + (text.size() > 40 ? "..." : "") + "'";
}

double number(const CsvReader& file, const std::string& field, const char* column) {
  const std::string_view text = trimmed(field);
  double value = 0;
  const char* const begin = text.data() + (text.starts_with('+') && !text.starts_with("+-") ? 1 : 0);
  const char* const end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(begin, end, value);
  const auto wrong = [&](const char* why) {
    return file.error("column " + std::string(column) + ": " + shown(text) + why);
  };
  if (failure == std::errc::result_out_of_range && stop == end)
    throw wrong(" is beyond the range of a double");
  if (failure != std::errc() || stop != end) throw wrong(" is not a number");
  if (!std::isfinite(value)) throw wrong(" is not finite");
  return value;
}

void check_length(const CsvReader& file, const std::vector<std::string>& row, const Columns& columns) {
  if (row.size() != columns.count) {
    throw file.error("the row has " + std::to_string(row.size()) + " fields, the header " +
                     std::to_string(columns.count));
  }
}

double radius_of(const CsvReader& file, const std::string& field) {
  const double radius = number(file, field, "radius");
  if (radius < 0) throw file.error("column radius: " + shown(field) + " is negative");
  return radius;
}

double time_after(const CsvReader& file, const std::string& field, const std::vector<double>& earlier) {
  const double time = number(file, field, "time_s");
  if (!earlier.empty() && time < earlier.back())
    throw file.error("column time_s: " + shown(field) + " is before the row above");
  return time;
}

void append(std::string& line, double value) {
  std::array<char, 32> text;
  const auto written = std::to_chars(text.data(), text.data() + text.size(), value);
  if (!line.empty()) line += ',';
  line.append(text.data(), written.ptr);
}

/// A step takes about four times its row, here and in the workers.
void require_memory_for(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error)
    require_memory("trajectory " + path + ": " + std::to_string(size) + " bytes",
                   4 * static_cast<double>(size));
}

}  // namespace

Trajectory read_trajectory(const std::string& path, std::size_t most) {
  CsvReader file(path);
  const Columns columns = read_header(file);
  if (most == 0) require_memory_for(path);
  Trajectory trajectory{path, {}, {}, {}};
  std::vector<std::string> row;
  while ((most == 0 || trajectory.size() < most) && file.next(row)) {
    check_length(file, row, columns);
    trajectory.positions.emplace_back(number(file, row[columns.position[0]], "x"),
                                      number(file, row[columns.position[1]], "y"),
                                      number(file, row[columns.position[2]], "z"));
    if (columns.radius) trajectory.radii.push_back(radius_of(file, row[*columns.radius]));
    if (columns.time) trajectory.times_s.push_back(time_after(file, row[*columns.time], trajectory.times_s));
  }
  if (trajectory.positions.empty()) throw file.error("no row follows the header");
  return trajectory;
}

void write_trajectory(const Trajectory& trajectory, const std::string& path) {
  AtomicFile file(path);
  const bool timed = !trajectory.times_s.empty(), sized = !trajectory.radii.empty();
  file.write(std::string(timed ? "time_s," : "") + "x,y,z" + (sized ? ",radius\n" : "\n"));
  std::string line;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    line.clear();
    if (timed) append(line, trajectory.times_s[i]);
    for (int axis = 0; axis < 3; ++axis) append(line, trajectory.positions[i][axis]);
    if (sized) append(line, trajectory.radii[i]);
    file.write(line += '\n');
  }
  file.commit();
}

}  // namespace touchmark::bench
