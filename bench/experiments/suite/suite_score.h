/// The score of a cell: the fastest rival's time over ours, and what all cells come to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/suite/suite_plan.h"
#include "bench/measurement/result_row.h"

namespace touchmark::bench::experiments::suite {

/// Names the fastest of our forms in each cell as a contestant of its own: what one that always chose right
/// would reach.
inline constexpr const char* best_of_ours = "best";

/// A cell with what was measured in it.
struct MeasuredCell {
  std::string mesh;  ///< without folders
  std::size_t triangles = 0;
  SuiteCell cell;
  std::vector<measurement::ResultRow> rows;  ///< empty: not measured
  bool conclusive = true;                    ///< the control took as long as what it repeats
};

/// Means below this are not compared: both are done before a loop could tell.
inline constexpr double min_mean_ns = 20;
/// Tails that differ by less are not compared.
inline constexpr double min_tail_difference_ns = 100;
/// Times with emptied caches are not compared where one is this near to the floor: that of nothing asked.
inline constexpr double min_above_floor_ns = 300;

/// Returns by how much a time is above the floor, and at least 1 ns.
double above_floor(double ns, double floor);

/// A contestant's time and, where it stands against ours, the ratio.
struct Rival {
  std::string contestant;
  double ns = 0;
  double ratio = 0;  ///< its time over ours, both less the floor: below 1 it is faster
  measurement::QuantileBounds ratio_bounds;  ///< with about 95 % confidence
  bool counts = true;                        ///< false: of the stress, or too short to be compared
  std::optional<double> build_ms;
  std::optional<std::uint64_t> bytes;

  bool is_ahead() const noexcept { return ratio_bounds.high < 1; }
  bool is_behind() const noexcept { return ratio_bounds.low > 1; }
};

/// One kind of time: the mean, or the tail.
struct Standing {
  std::optional<double> ns;    ///< ours; nothing where it has none
  std::optional<Rival> exact;  ///< the fastest that claims exactness and was right
  std::optional<Rival> any;    ///< the fastest, in single precision and approximate ones included
};

/// One row of suite.csv: one of ours in one cell.
struct SuiteRow {
  std::string mesh;
  std::size_t triangles = 0;
  SuiteCell cell;
  Caches caches = Caches::warm;
  double floor_ns = 0;  ///< what was measured with nothing asked and as many caches emptied
  std::string ours;     ///< a contestant, or best_of_ours
  std::string form;     ///< the contestant whose times these are; empty where none has any
  std::string status;   ///< ok, not measured, or no answer
  std::size_t steps = 0;
  Standing mean, tail;  ///< warm: undisturbed mean and 99.9 %; else median and 99 %
  std::optional<double> build_ms;
  std::optional<std::uint64_t> bytes;
  bool conclusive = true;

  /// Returns what tells cells apart: "slide:speed=0.1%, nearest within 0.5%, warm".
  std::string question() const;
};

/// True of a detector that is one of ours.
using IsOurs = std::function<bool(const std::string& detector)>;

/// Returns the rows of a cell: one for each of `ours` and for the best of them, warm, and as many with the
/// second-level cache and with all caches emptied where that was planned.
std::vector<SuiteRow> score(const MeasuredCell& cell, const std::vector<std::string>& ours,
                            const IsOurs& is_ours);

/// What many ratios come to.
struct Summary {
  std::size_t cells = 0;
  std::size_t behind = 0, undecided = 0;  ///< surely below 1; neither surely below nor above
  double geometric_mean = 0, median = 0, worst = 0;
  const SuiteRow* worst_row = nullptr;
};

/// Takes the rival of one kind out of a row, or nothing.
using RivalOf = const std::optional<Rival>& (*)(const SuiteRow& row);

/// Sums up the ratios of the rows, whether they count or not. Returns nothing where there is none. Keeps a
/// pointer to a row.
std::optional<Summary> summary_of(const std::vector<const SuiteRow*>& rows, RivalOf rival);

const std::optional<Rival>& exact_mean(const SuiteRow& row);
const std::optional<Rival>& any_mean(const SuiteRow& row);
const std::optional<Rival>& exact_tail(const SuiteRow& row);
const std::optional<Rival>& any_tail(const SuiteRow& row);

}  // namespace touchmark::bench::experiments::suite
