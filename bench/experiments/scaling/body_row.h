/// What one contestant did with a scene of so many bodies: a row of bodies.csv and of the printed tables.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/experiments/scaling/power_law.h"
#include "bench/results/column.h"
#include "bench/results/validation/fault.h"
#include "bench/results/validation/results_check.h"

namespace touchmark::bench::experiments::scaling {

inline constexpr int bodies_schema = 1;

/// The probe is where no body is near, or beside one.
enum class Place { free, beside };
std::string_view name_of(Place place) noexcept;

struct BodyRow {
  std::string detector;
  std::string options;  ///< as written out: "key=value,..."
  std::size_t bodies = 0;
  std::string motion;  ///< as in the scene's name
  Place place = Place::free;
  std::size_t moved = 0;  ///< bodies that are placed before each frame
  std::size_t frames = 0;
  std::size_t ticks_a_frame = 0;
  double build_ms = 0;
  std::size_t bytes = 0;
  std::optional<double> bytes_per_body = {};       ///< beside shapes; nothing with one body
  std::optional<double> publish_ns_per_body = {};  ///< nothing where bodies stand
  double first_tick_ns = 0;                        ///< right after a frame was published
  double tick_ns = 0;                              ///< a later tick of a frame
  std::optional<double> tick_over_one = {};        ///< over that with one body, timed in turns
  std::size_t found = 0;                           ///< ticks with a body in reach
  std::size_t differing = 0;                       ///< answers that are not those of the first contestant
  std::string status = "ok";                       ///< else differs, or refused: ...
  /// With what the contestant prepares after a frame, outside of the ticks; nothing where it does not.
  std::optional<double> prepare_ns = {};
  std::optional<double> first_tick_prepared_ns = {};
  std::optional<double> tick_prepared_ns = {};
  std::optional<double> tick_prepared_over_one = {};
  std::optional<double> first_tick_over_one = {};  ///< Exists where a clock tells it.
  std::optional<double> first_tick_prepared_over_one = {};

  std::string contestant() const { return options.empty() ? detector : detector + ":" + options; }
};

/// The columns of bodies.csv, schema 1. Columns are only ever appended.
std::span<const results::Column<BodyRow>> body_columns();
std::string bodies_csv(const std::vector<BodyRow>& rows);

/// A table for each motion and place: times by the number of bodies, and the exponents of the power laws
/// through them.
std::string bodies_table(const std::vector<BodyRow>& rows);

/// One quantity of one contestant with one motion and place.
struct BodyGrowth {
  std::string detector, options, motion;
  Place place = Place::free;
  std::string_view quantity;  ///< its column in bodies.csv
  PowerLaw law;
};
/// Fits rows that are ok, where there are two different numbers of bodies.
std::vector<BodyGrowth> growth_of(const std::vector<BodyRow>& rows);
std::string bodies_growth_csv(const std::vector<BodyGrowth>& growths);

/// Checks that a file is a bodies.csv of schema 1, and agrees with itself.
void check_bodies(const results::validation::CsvTable& table, results::validation::Faults& faults);

}  // namespace touchmark::bench::experiments::scaling
