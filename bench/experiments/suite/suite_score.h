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

/// A contestant's time and, where it stands against ours, the ratio.
struct Rival {
  std::string contestant;
  double ns = 0;
  double ratio = 0;  ///< its time over ours: below 1 it is faster
  std::optional<double> build_ms;
  std::optional<std::uint64_t> bytes;
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
  SuiteCell cell;      ///< its `cold` says which times these are
  std::string ours;    ///< a contestant, or best_of_ours
  std::string form;    ///< the contestant whose times these are; empty where none has any
  std::string status;  ///< ok, not measured, or no answer
  std::size_t steps = 0;
  Standing mean, tail;  ///< warm: undisturbed mean and 99.9 %; cold: median and 99 %
  std::optional<double> build_ms;
  std::optional<std::uint64_t> bytes;
  bool conclusive = true;

  /// Returns what tells cells apart: "slide:speed=0.1%, nearest within 0.5%, warm".
  std::string question() const;
};

/// True of a detector that is one of ours.
using IsOurs = std::function<bool(const std::string& detector)>;

/// Returns the rows of a cell: one for each of `ours` and for the best of them, warm, and as many cold ones
/// where that was planned.
std::vector<SuiteRow> score(const MeasuredCell& cell, const std::vector<std::string>& ours,
                            const IsOurs& is_ours);

/// What many ratios come to.
struct Summary {
  std::size_t cells = 0;
  std::size_t lost = 0;  ///< below 1
  double geometric_mean = 0, median = 0, worst = 0;
  const SuiteRow* worst_row = nullptr;
};

/// Takes a ratio out of a row, or nothing.
using RatioOf = std::optional<double> (*)(const SuiteRow& row);

/// Returns nothing where no row has such a ratio. Keeps a pointer into `rows`.
std::optional<Summary> summary_of(const std::vector<SuiteRow>& rows, const std::string& ours, RatioOf ratio);

std::optional<double> exact_mean(const SuiteRow& row);
std::optional<double> any_mean(const SuiteRow& row);
std::optional<double> exact_tail(const SuiteRow& row);
std::optional<double> any_tail(const SuiteRow& row);

}  // namespace touchmark::bench::experiments::suite
