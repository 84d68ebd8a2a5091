/// How much the machine's other work disturbed a comparison, and whether its times can be believed: one
/// contestant is timed twice, in two processes, and both must take equally long.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/measurement/result_row.h"

namespace touchmark::bench::measurement {

/// Times further apart than this are told apart; nearer ones are not.
inline constexpr double resolution = 1.15;

/// A contestant once more, as `control` is of a row.
struct Control {
  std::string contestant;
  double ratio = 1;  ///< the second process's time over the first one's
  double low = 1;    ///< ends of the interval that follows from both times' intervals
  double high = 1;

  bool ties() const noexcept { return ratio <= resolution && ratio * resolution >= 1; }
};

/// Says how steady the rows of one trajectory and query are.
struct Steadiness {
  std::string mesh, trajectory;
  workload::Query query = workload::Query::nearest;
  double disturbed_share = 0;  ///< the mean over the rows with times
  std::optional<Control> control;

  bool conclusive() const noexcept { return !control || control->ties(); }
};

/// `control` is the row of a second process of the contestant of `row`; nothing unless both have times.
std::optional<Control> control_of(const ResultRow& row, const ResultRow& control);

/// At least one row.
Steadiness steadiness_of(const std::vector<ResultRow>& rows, std::optional<Control> control);

/// Returns the fastest row that claims exactness and was right; null where there is none with times.
const ResultRow* fastest_exact(const std::vector<ResultRow>& rows);

}  // namespace touchmark::bench::measurement
