#include "bench/trajectories/trajectory_csv.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/support/files/csv_reader.h"
#include "bench/support/system/available_memory.h"
#include "bench/trajectories/motion_columns.h"
#include "bench/trajectories/motion_field.h"
#include "bench/trajectories/resampling.h"

namespace touchmark::bench::trajectories {
namespace {

constexpr double max_ticks = 100'000'000;  // of a resampled motion, as of --steps
constexpr double bytes_a_tick = 256;       // here and in the workers
constexpr double min_origin_s = 1e6;       // doubles below hold times to 1e-10 s
constexpr double max_origin_s = 9e9;       // 64 bits hold nanoseconds of less

double unit_s(int decimals) { return decimals == 0 ? 1 : decimals == 3 ? 1e-3 : decimals == 6 ? 1e-6 : 1e-9; }

/// Reads the rows of one file.
class MotionReader {
 public:
  MotionReader(support::CsvReader& file, const std::string& path, std::size_t most,
               const MotionOptions& options)
      : file_(file),
        max_(most),
        options_(options),
        numbers_(file),
        columns_(read_motion_header(file, options.columns, row_)),
        first_line_(file.line()),
        motion_{path, {}, {}, {}} {
    if (options.of_a_scene && columns_.guessed_times) leave_times();
    if (options.of_a_scene && !columns_.time) options_.rate_hz.reset();
    if (options_.rate_hz && !columns_.time)
      throw file.error_at(columns_.line,
                          "--rate needs times, and the header has no column time_s (or --columns name none)");
  }

  Trajectory read() {
    while (!has_enough() && next_row()) add_row();
    if (motion_.positions.empty()) throw file_.error_at(columns_.line, "no row follows the header");
    if (columns_.time) check_times();
    if (options_.rate_hz) {
      const auto recorded = motion_.recorded;
      motion_ = resampled(motion_, *options_.rate_hz, max_);
      motion_.recorded = recorded;
    }
    // The bodies of a scene move by the same clock.
    if (options_.of_a_scene)
      for (double& time : motion_.times_s) time += origin_s_;
    return std::move(motion_);
  }

 private:
  /// Spreadsheets leave rows of empty fields, and empty fields at the end of rows.
  bool next_row() {
    if ((motion_.size() > 0 || row_.empty()) && !read_next_row(file_, row_)) return false;
    const bool rest_is_blank =
        row_.size() > columns_.count &&
        std::all_of(row_.begin() + static_cast<std::ptrdiff_t>(columns_.count), row_.end(),
                    [](const std::string& field) { return trimmed(field).empty(); });
    if (row_.size() < columns_.min_count || (row_.size() > columns_.count && !rest_is_blank))
      throw file_.error(fmt::format("the row has {} fields, the {} {}", row_.size(),
                                    columns_.line < first_line_ ? "header" : "first row", columns_.count));
    return true;
  }

  /// True once the rows hold as many steps as are wanted.
  bool has_enough() const {
    if (max_ == 0 || motion_.size() == 0) return false;
    if (!options_.rate_hz) return motion_.size() >= max_;
    return ticks_at(motion_, *options_.rate_hz) >= static_cast<double>(max_);
  }

  void add_row() {
    const auto& [x, y, z] = columns_.position;
    const double px = coordinate(x), py = coordinate(y), pz = coordinate(z);
    motion_.positions.emplace_back(px, py, pz);
    if (columns_.radius) {
      const double radius = coordinate(*columns_.radius);
      if (radius < 0)
        throw file_.error("column " + columns_.radius->name + ": " +
                          shown(trimmed(row_[columns_.radius->index])) + " is negative");
      motion_.radii.push_back(radius);
    }
    if (!columns_.time) return;
    try {
      add_time();
    } catch (const std::invalid_argument&) {
      if (!may_leave_times()) throw;
      leave_times();
    }
  }

  double coordinate(const MotionColumn& column) {
    const std::string& field = row_[column.index];
    const double value = numbers_.read(field, column.name) * options_.scale.value_or(1);
    if (!std::isfinite(value))
      throw file_.error("column " + column.name + ": " + shown(trimmed(field)) +
                        " times --motion-scale is beyond the range of a double");
    return value;
  }

  /// Returns the row's time in seconds; of a motion since 1970, after its first row.
  double time_of_row() {
    auto& [column, decimals] = *columns_.time;
    const auto field = [&](const TimeColumn& time) { return trimmed(row_[time.column.index]); };
    double time = numbers_.read(row_[column.index], column.name);
    if (!decimals) decimals = decimals_of_date(time).value_or(0);
    time *= unit_s(*decimals);
    const double whole = time;
    if (const std::optional<TimeColumn>& rest = columns_.time_rest) {
      const double part =
          numbers_.read(row_[rest->column.index], rest->column.name) * unit_s(*rest->decimals);
      if (whole != std::floor(whole) || !(part >= 0 && part < 1))
        throw file_.error(fmt::format("columns {} and {}: {} and {} are not whole seconds and less than one",
                                      column.name, rest->column.name, shown(field(*columns_.time)),
                                      shown(field(*rest))));
      time += part;
    }
    if (motion_.times_s.empty() && std::abs(time) >= min_origin_s) origin_s_ = time;
    if (origin_s_ == 0) return time;
    if (std::max(std::abs(time), std::abs(origin_s_)) > max_origin_s) return time - origin_s_;
    std::int64_t nanoseconds = nanoseconds_of(field(*columns_.time), *decimals);
    if (const auto& rest = columns_.time_rest) nanoseconds += nanoseconds_of(field(*rest), *rest->decimals);
    if (motion_.times_s.empty()) origin_ns_ = nanoseconds;
    return static_cast<double>(nanoseconds - origin_ns_) / 1e9;
  }

  void add_time() {
    const double time = time_of_row();
    if (!motion_.times_s.empty() && !(time > motion_.times_s.back())) {
      const std::optional<TimeColumn>& rest = columns_.time_rest;
      const auto field = [&](const TimeColumn& of) { return trimmed(row_[of.column.index]); };
      throw file_.error(fmt::format(
          "column {}: {}{} is not after the row before (--columns without time does not read times)",
          columns_.time->column.name, shown(field(*columns_.time)),
          rest ? fmt::format(" and {} in column {}", shown(field(*rest)), rest->column.name) : ""));
    }
    motion_.times_s.push_back(time);
    lines_.push_back(file_.line());
  }

  void check_times() {
    const std::vector<double>& times = motion_.times_s;
    const double duration = times.back() - times.front();
    if (!std::isfinite(duration))
      throw file_.error("column " + columns_.time->column.name + ": the duration overflows");
    const std::size_t gap = options_.of_a_scene || options_.rate_hz ? 0 : first_gap(times);
    if (gap > 0 && may_leave_times()) return leave_times();
    motion_.recorded = RecordedTiming{times.size(), duration, options_.rate_hz};
    if (options_.rate_hz) {
      const double ticks = ticks_at(motion_, *options_.rate_hz);
      if (max_ == 0 && ticks > max_ticks)
        throw std::invalid_argument(fmt::format("{}: {} s at --rate {} are {:.0f} steps, more than {:.0f}",
                                                motion_.name, duration, *options_.rate_hz, ticks, max_ticks));
      const double steps = max_ == 0 ? ticks : std::min(ticks, static_cast<double>(max_));
      support::require_memory(fmt::format("trajectory {}: {:.0f} steps", motion_.name, steps),
                              bytes_a_tick * steps);
    } else if (gap > 0) {
      throw file_.error_at(lines_[gap],
                           fmt::format("column {}: {:.6g} s after the row before, longer than the usual "
                                       "interval: rows are not evenly spaced; --rate HZ resamples them",
                                       columns_.time->column.name, times[gap] - times[gap - 1]));
    }
  }

  bool may_leave_times() const { return columns_.guessed_times && !options_.rate_hz; }
  /// Makes the motion one without times.
  void leave_times() {
    columns_.time.reset();
    motion_.times_s.clear();
  }

  support::CsvReader& file_;
  std::size_t max_;
  MotionOptions options_;
  NumberReader numbers_;
  std::vector<std::string> row_;  // at first what was read in search of a header
  MotionColumns columns_;
  std::size_t first_line_;  // of the first row
  Trajectory motion_;
  std::vector<std::size_t> lines_;  // of rows with times
  double origin_s_ = 0;             // from which times are counted
  std::int64_t origin_ns_ = 0;
};

/// A step takes about four times its row, here and in the workers.
void require_memory_for(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error)
    support::require_memory("trajectory " + path + ": " + std::to_string(size) + " bytes",
                            4 * static_cast<double>(size));
}

}  // namespace

Trajectory read_trajectory(const std::string& path, std::size_t most, const MotionOptions& options) {
  support::CsvReader file(path);
  file.accept_any_dialect();
  if (most == 0) require_memory_for(path);
  return MotionReader(file, path, most, options).read();
}

}  // namespace touchmark::bench::trajectories
