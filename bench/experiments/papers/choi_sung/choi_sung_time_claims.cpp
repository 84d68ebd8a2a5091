/// Choi & Sung's times and rates. They are of a machine that is not described, and hold more than the search,
/// so what is compared is their slope over the spheres, their ratios and their order.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/experiments/papers/choi_sung/choi_sung_claim_list.h"
#include "bench/experiments/papers/choi_sung/choi_sung_printed.h"
#include "bench/experiments/papers/line_fit.h"

namespace touchmark::bench::experiments::papers {
namespace {

using enum SubdivisionMethod;
namespace printed = choi_sung_printed;

/// Milliseconds over spheres.
using Points = std::array<std::pair<double, double>, 4>;

/// The period of a printed tick over the printed spheres.
Points printed_ticks(bool clustered) {
  Points points;
  for (std::size_t level = 0; level < points.size(); ++level) {
    const printed::Level& p = printed::ls3[level];
    points[level] = {clustered ? p.clustered_spheres : p.spheres,
                     1e3 / (clustered ? p.clustered_update_hz : p.update_hz)};
  }
  return points;
}

/// By how much a printed detection time exceeds the printed tick that it should be a part of.
double excess(std::size_t level, bool clustered) {
  const printed::Level& p = printed::ls3[level];
  return (clustered ? p.clustered_detection_ms : p.detection_ms) - printed_ticks(clustered)[level].second;
}

/// Why printed times are not the search alone.
std::string fixed_parts() {
  double mean = 0, spread = 0;
  for (const bool clustered : {false, true})
    for (std::size_t level = 0; level < 4; ++level) mean += excess(level, clustered) / 8;
  for (const bool clustered : {false, true})
    for (std::size_t level = 0; level < 4; ++level)
      spread += (excess(level, clustered) - mean) * (excess(level, clustered) - mean) / 8;
  const LineFit single = line_through(printed_ticks(false)), clustered = line_through(printed_ticks(true));
  return fmt::format(
      "the printed detection time is the printed tick (1000 / rate) and {:.2f} +- {:.2f} ms at every level, "
      "without and with clustering: one measurement with an offset; the tick itself is {:.2f} ms and {:.3f} "
      "us a sphere without clustering, {:.2f} ms and {:.2f} us a sphere with it. What does not grow with the "
      "spheres is no search; ours are the search alone",
      mean, std::sqrt(spread), single.offset, 1e3 * single.slope, clustered.offset, 1e3 * clustered.slope);
}

LineFit our_line(const ChoiSungClaimList& list, bool clustered, const RowValue& of) {
  Points points;
  for (int level = 0; level <= 3; ++level) {
    const ChoiSungRow& row = *list.find(ls3, level, clustered);
    points[static_cast<std::size_t>(level)] = {static_cast<double>(row.spheres), of(row)};
  }
  return line_through(points);
}

const RowValue nanoseconds = [](const ChoiSungRow& row) { return row.scan->ns; };
const RowValue tests = [](const ChoiSungRow& row) { return row.scan->work; };

void add_slopes(ChoiSungClaimList& list) {
  const LineFit theirs = line_through(printed_ticks(false)),
                theirs_clustered = line_through(printed_ticks(true));
  const LineFit ours = our_line(list, false, nanoseconds), ours_clustered = our_line(list, true, nanoseconds);
  const char* const where = "Table 3, slope over the levels";
  const std::string reason = "another machine and a vectorised loop; theirs is not described";
  list.add(
      time_claim(where, "us a sphere without clustering", 1e3 * theirs.slope, 1e-3 * ours.slope, 4, reason));
  list.add(time_claim(where, "us a sphere with clustering", 1e3 * theirs_clustered.slope,
                      1e-3 * ours_clustered.slope, 4, reason));
  list.add(number_claim(where, "a clustered sphere over one without clustering",
                        theirs_clustered.slope / theirs.slope, ours_clustered.slope / ours.slope, 2, 0.1,
                        list.why("a clustered sphere holds more triangles, and what those cost over a sphere "
                                 "is of the machine and the program")));
  const LineFit counted = our_line(list, false, tests);
  list.add("Fig. 10", "without clustering the time grows in proportion to the spheres",
           std::abs(counted.slope - 1) < 0.01,
           fmt::format("{:.3f} tests a sphere over the levels, {:.2f} ns", counted.slope, ours.slope));
}

/// Table 3's three ratios: the Discussion says of each that it grows with the level.
void add_growing_ratios(ChoiSungClaimList& list) {
  const auto gains = [&](const RowValue& of) {
    return over_levels(
        0, [&](int level) { return list.value(ls3, level, false, of) / list.value(ls3, level, true, of); });
  };
  const std::vector<double> by_time = gains(nanoseconds), by_tests = gains(tests);
  list.add("Discussion", "the reduction of the detection time grows with the level (LS3)",
           rises(by_time) && rises(by_tests),
           fmt::format("without over with clustering: {:.2f} in time, {:.2f} in tests",
                       fmt::join(by_time, ", "), fmt::join(by_tests, ", ")));
  list.add("Discussion", "the increment of the update rate grows with the level (LS3)",
           rises(by_time) && rises(by_tests), "the same ratios: a rate is the inverse of a time");
}

/// "the growth rate with clustering becomes more flat as the levels become higher".
void add_flattening(ChoiSungClaimList& list) {
  const std::vector<double> growth = over_levels(1, [&](int level) {
    return list.value(ls3, level, true, tests) / list.value(ls3, level - 1, true, tests);
  });
  list.add("Fig. 10", "with clustering the growth gets flatter as the levels get higher (LS3)", falls(growth),
           fmt::format("from level to level {:.2f} times the tests", fmt::join(growth, ", ")));
}

void add_threshold_claims(ChoiSungClaimList& list) {
  const std::vector<double> all =
      over_levels(0, [&](int level) { return list.value(ls3, level, false, tests); });
  const bool better = std::ranges::min(all) < all.front();
  list.add("Abstract", "performance becomes better until a certain threshold and degrades afterward", better,
           fmt::format("tests a query over the levels, without clustering: {:.0f}", fmt::join(all, ", ")),
           "no level is faster than the one before, in the paper's Table 3 neither; what has such a "
           "threshold is the distance of clustering (distances.csv)");
  const double gain = list.value(ls3, 3, false, tests) / list.value(ls3, 3, true, tests);
  list.add("Abstract", "clustering improves the speed of detection notably", gain > 1.5,
           fmt::format("{:.1f} times fewer tests at level 3", gain));
}

}  // namespace

void add_time_claims(ChoiSungClaimList& list, int level) {
  const ChoiSungRow* single = list.find(ls3, level, false);
  const ChoiSungRow* clustered = list.find(ls3, level, true);
  if (single == nullptr || clustered == nullptr) return;
  const printed::Level& p = printed::ls3[static_cast<std::size_t>(level)];
  const std::string where = fmt::format("Table 3, LS3 level {}", level), reason = list.why(fixed_parts());
  const double a = single->scan->ns * 1e-6, b = clustered->scan->ns * 1e-6;
  const auto time = [&](const char* what, double theirs, double ours, int digits) {
    list.add(time_claim(where, what, theirs, ours, digits, reason));
  };
  const auto ratio = [&](const char* what, double theirs, double ours, int digits) {
    list.add(number_claim(where, what, theirs, ours, digits, 0.1, reason));
  };
  time("detection without clustering, ms", p.detection_ms, a, 4);
  time("detection with clustering, ms", p.clustered_detection_ms, b, 4);
  ratio("reduction of detection time, %", p.detection_reduction_percent, 100 * (1 - b / a), 0);
  if (level > 0) {
    const double a0 = list.find(ls3, 0, false)->scan->ns * 1e-6;
    ratio("detection time to level 0's", p.detection_ms / printed::ls3[0].detection_ms, a / a0, 2);
  }
  time("update rate without clustering, Hz", p.update_hz, 1e3 / a, 0);
  time("update rate with clustering, Hz", p.clustered_update_hz, 1e3 / b, 0);
  ratio("increment of update rate, %", p.update_increment_percent, 100 * (a / b - 1), 0);
}

void add_time_statements(ChoiSungClaimList& list) {
  add_slopes(list);
  add_growing_ratios(list);
  add_flattening(list);
  add_threshold_claims(list);
  list.add_best("Fig. 10", "Loop detects fastest, without clustering", loop, 3, false, nanoseconds,
                "the number of spheres decides; methods that differ little in it are within the noise");
  list.add_best("Fig. 10", "Loop detects fastest, with clustering", loop, 3, true, nanoseconds,
                "the clustered spheres hold many triangles, whose search outweighs the count of spheres");
  list.add_best("Fig. 11", "Loop with clustering has the best update rate", loop, 3, true, nanoseconds,
                "a rate is the inverse of a time");
  const auto growth = [&](bool clustered) {
    return list.value(ls3, 3, clustered, nanoseconds) / list.value(ls3, 0, clustered, nanoseconds);
  };
  list.add("Fig. 10", "with clustering the time grows less with the levels (LS3)",
           growth(true) < growth(false),
           fmt::format("{:.1f} times with, {:.1f} times without", growth(true), growth(false)));
  const std::vector<ChoiSungRow>& rows = list.result().rows;
  const auto below = std::ranges::count_if(
      rows, [](const ChoiSungRow& row) { return row.surface.level > 0 && row.scan->ns > 1e6; });
  Claim claim{"Fig. 11",
              "no subdivided surface is served at 1000 Hz",
              "holds",
              fmt::format("{} of {} are below 1000 Hz", below, rows.size() - 2),
              Agreement::not_comparable,
              list.why(fixed_parts())};
  list.add(std::move(claim));
  list.add("Fig. 11", "subdivision should not be applied if the rate is to be kept", below > 0,
           fmt::format("the slowest surface is searched {:.0f} times a second",
                       1e9 / std::ranges::max_element(
                                 rows, [](const auto& a, const auto& b) { return a.scan->ns < b.scan->ns; })
                                 ->scan->ns),
           "it follows from times that hold more than the search");
}

}  // namespace touchmark::bench::experiments::papers
