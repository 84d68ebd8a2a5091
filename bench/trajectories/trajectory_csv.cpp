#include "bench/trajectories/trajectory_csv.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/support/available_memory.h"
#include "bench/support/csv_reader.h"
#include "bench/trajectories/motion_columns.h"
#include "bench/trajectories/motion_field.h"
#include "bench/trajectories/resampling.h"

namespace touchmark::bench::trajectories {
namespace {

constexpr double max_ticks = 100'000'000;  // of a resampled motion, as of --steps
constexpr double bytes_a_tick = 256;       // here and in the workers

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
        motion_{path, {}, {}, {}} {
    if (options.of_a_scene && !columns_.time) options_.rate_hz.reset();
    if (options_.rate_hz && !columns_.time)
      throw file.error("--rate needs times, and the header has no column time_s (or --columns name none)");
  }

  Trajectory read();

 private:
  bool next_row();
  bool has_enough() const;
  void add_row();
  double coordinate(const MotionColumn& column);
  void add_time(const MotionColumn& column);
  void check_times();
  [[noreturn]] void fail(std::size_t line, const std::string& what) const;

  support::CsvReader& file_;
  std::size_t max_;
  MotionOptions options_;
  NumberReader numbers_;
  std::vector<std::string> row_;  // at first what was read in search of a header
  MotionColumns columns_;
  Trajectory motion_;
  std::vector<std::size_t> lines_;  // of rows with times
};

bool is_blank(const std::string& field) { return trimmed(field).empty(); }

/// Spreadsheets leave rows of empty fields, and empty fields at the end of rows.
bool MotionReader::next_row() {
  if (motion_.size() > 0 || row_.empty()) {
    do {
      if (!file_.next(row_)) return false;
    } while (row_.size() > 1 && std::all_of(row_.begin(), row_.end(), is_blank));
  }
  const bool rest_is_blank =
      row_.size() > columns_.count &&
      std::all_of(row_.begin() + static_cast<std::ptrdiff_t>(columns_.count), row_.end(), is_blank);
  if (row_.size() != columns_.count && !rest_is_blank) {
    throw file_.error("the row has " + std::to_string(row_.size()) + " fields, the header " +
                      std::to_string(columns_.count));
  }
  return true;
}

/// True once the rows hold as many steps as are wanted.
bool MotionReader::has_enough() const {
  if (max_ == 0 || motion_.size() == 0) return false;
  if (!options_.rate_hz) return motion_.size() >= max_;
  return ticks_at(motion_, *options_.rate_hz) >= static_cast<double>(max_);
}

double MotionReader::coordinate(const MotionColumn& column) {
  const std::string& field = row_[column.index];
  const double value = numbers_.read(field, column.name) * options_.scale;
  if (!std::isfinite(value)) {
    throw file_.error("column " + column.name + ": " + shown(trimmed(field)) +
                      " times --motion-scale is beyond the range of a double");
  }
  return value;
}

void MotionReader::add_time(const MotionColumn& column) {
  const std::string& field = row_[column.index];
  const double time = numbers_.read(field, column.name) * columns_.seconds;
  if (!motion_.times_s.empty() && !(time > motion_.times_s.back())) {
    throw file_.error("column " + column.name + ": " + shown(trimmed(field)) +
                      " is not after the row before (--columns without time does not read times)");
  }
  motion_.times_s.push_back(time);
  lines_.push_back(file_.line());
}

void MotionReader::add_row() {
  const auto& [x, y, z] = columns_.position;
  const double px = coordinate(x), py = coordinate(y), pz = coordinate(z);
  motion_.positions.emplace_back(px, py, pz);
  if (columns_.radius) {
    const double radius = coordinate(*columns_.radius);
    if (radius < 0) {
      throw file_.error("column " + columns_.radius->name + ": " +
                        shown(trimmed(row_[columns_.radius->index])) + " is negative");
    }
    motion_.radii.push_back(radius);
  }
  if (columns_.time) add_time(*columns_.time);
}

void MotionReader::fail(std::size_t line, const std::string& what) const {
  throw std::invalid_argument(fmt::format("{}:{}: {}", motion_.name, line, what));
}

void MotionReader::check_times() {
  const std::vector<double>& times = motion_.times_s;
  const double duration = times.back() - times.front();
  if (!std::isfinite(duration))
    throw file_.error("column " + columns_.time->name + ": the duration overflows");
  motion_.recorded = RecordedTiming{times.size(), duration, options_.rate_hz};
  if (options_.rate_hz) {
    const double ticks = ticks_at(motion_, *options_.rate_hz);
    if (max_ == 0 && ticks > max_ticks) {
      throw std::invalid_argument(fmt::format("{}: {} s at --rate {} are {:.0f} steps, more than {:.0f}",
                                              motion_.name, duration, *options_.rate_hz, ticks, max_ticks));
    }
    const double steps = max_ == 0 ? ticks : std::min(ticks, static_cast<double>(max_));
    support::require_memory(fmt::format("trajectory {}: {:.0f} steps", motion_.name, steps),
                            bytes_a_tick * steps);
  } else if (const std::size_t row = options_.of_a_scene ? 0 : first_gap(times)) {
    fail(lines_[row],
         fmt::format("column {}: {:.6g} s after the row before, longer than the usual interval: rows "
                     "are not evenly spaced; --rate HZ resamples them",
                     columns_.time->name, times[row] - times[row - 1]));
  }
}

Trajectory MotionReader::read() {
  while (!has_enough() && next_row()) add_row();
  if (motion_.positions.empty()) throw file_.error("no row follows the header");
  if (!columns_.time) return std::move(motion_);
  check_times();
  if (!options_.rate_hz) return std::move(motion_);
  Trajectory ticks = resampled(motion_, *options_.rate_hz, max_);
  ticks.recorded = motion_.recorded;
  return ticks;
}

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
