#include "bench/experiments/suite/suite_score.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/support/median.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::suite {
namespace {

using measurement::ResultRow;
/// A time and where it lies with about 95 % confidence.
struct Time {
  double ns = 0, low = 0, high = 0;
};
using TimeOf = std::optional<Time> (*)(const ResultRow& row);
using ColdOf = std::optional<measurement::ColdSummary> ResultRow::*;

std::optional<Time> warm_mean(const ResultRow& row) {
  if (!row.throughput) return std::nullopt;
  const measurement::UndisturbedTime& time = row.throughput->undisturbed;
  return Time{time.ns, time.low, time.high};
}
std::optional<Time> warm_tail(const ResultRow& row) {
  const std::optional<double> p999 = measurement::p999_of(row, row.latency);
  if (!p999) return std::nullopt;
  return Time{*p999, row.latency->p999_bounds.low, row.latency->p999_bounds.high};
}
template <ColdOf summary>
std::optional<Time> cold_median(const ResultRow& row) {
  const auto& cold = row.*summary;
  if (!cold) return std::nullopt;
  return Time{cold->p50, cold->p50_bounds.low, cold->p50_bounds.high};
}
template <ColdOf summary>
std::optional<Time> cold_tail(const ResultRow& row) {
  const auto& cold = row.*summary;
  if (!cold || cold->samples < measurement::samples_for_p99) return std::nullopt;
  return Time{cold->p99, cold->p99_bounds.low, cold->p99_bounds.high};
}

/// How the times of a state of the caches are taken from a row.
struct TimesOf {
  TimeOf mean, tail;
  double ResultRow::*floor;  ///< null: none is taken off
};

TimesOf times_of(Caches caches) {
  switch (caches) {
    case Caches::warm:
      return {warm_mean, warm_tail, nullptr};
    case Caches::l2:
      return {cold_median<&ResultRow::cold_l2>, cold_tail<&ResultRow::cold_l2>, &ResultRow::cold_floor_l2_ns};
    case Caches::cold:
      break;
  }
  return {cold_median<&ResultRow::cold>, cold_tail<&ResultRow::cold>, &ResultRow::cold_floor_ns};
}

/// Returns the median of what the rows measured with nothing asked.
double floor_of(const std::vector<ResultRow>& rows, double ResultRow::*floor) {
  std::vector<double> all;
  for (const ResultRow& row : rows)
    if (floor != nullptr && row.throughput) all.push_back(row.*floor);
  return all.empty() ? 0 : support::median(all);
}

bool is_right(const ResultRow& row) { return row.status == "ok" && !row.violates_guarantee(); }

/// The rivals of one cell and state of the caches, and who of ours is measured against them.
class Field {
 public:
  Field(const MeasuredCell& cell, const IsOurs& is_ours, bool has_floor, double floor)
      : cell_(cell), is_ours_(is_ours), has_floor_(has_floor), floor_(floor) {}

  Standing standing(const ResultRow* ours, TimeOf time, bool is_tail) const {
    Standing standing;
    const std::optional<Time> taken = ours == nullptr ? std::nullopt : time(*ours);
    if (!taken || !(taken->ns > 0)) return standing;
    standing.ns = taken->ns;
    standing.exact = fastest(time, *taken, is_tail, true);
    standing.any = fastest(time, *taken, is_tail, false);
    return standing;
  }

 private:
  std::optional<Rival> fastest(TimeOf time, const Time& ours, bool is_tail, bool exact) const {
    const ResultRow* best = nullptr;
    for (const ResultRow& row : cell_.rows) {
      if (is_ours_(row.detector) || row.status != "ok" || !time(row)) continue;
      if (exact && !(row.claims_exactness() && is_right(row))) continue;
      if (best == nullptr || time(row)->ns < time(*best)->ns) best = &row;
    }
    if (best == nullptr) return std::nullopt;
    const Time theirs = *time(*best);
    return Rival{best->contestant(),
                 theirs.ns,
                 ratio(theirs.ns, ours.ns),
                 {ratio(theirs.low, ours.high), ratio(theirs.high, ours.low)},
                 !cell_.cell.stress && is_comparable(theirs.ns, ours.ns, is_tail),
                 best->build_ms,
                 best->bytes};
  }
  double ratio(double theirs, double ours) const {
    return above_floor(theirs, floor_) / above_floor(ours, floor_);
  }
  bool is_comparable(double theirs, double ours, bool is_tail) const {
    if (has_floor_ && std::min(theirs, ours) < floor_ + min_above_floor_ns) return false;
    if (is_tail) return std::abs(theirs - ours) >= min_tail_difference_ns;
    return has_floor_ || std::max(theirs, ours) >= min_mean_ns;
  }

  const MeasuredCell& cell_;
  const IsOurs& is_ours_;
  bool has_floor_;
  double floor_;
};

const ResultRow* row_of(const std::vector<ResultRow>& rows, const std::string& contestant, TimeOf time) {
  const auto found = std::ranges::find_if(rows, [&](const ResultRow& row) {
    return row.contestant() == contestant && is_right(row) && time(row);
  });
  return found == rows.end() ? nullptr : &*found;
}

const ResultRow* fastest_of(const std::vector<ResultRow>& rows, const std::vector<std::string>& ours,
                            TimeOf time) {
  const ResultRow* best = nullptr;
  for (const std::string& contestant : ours) {
    const ResultRow* const row = row_of(rows, contestant, time);
    if (row != nullptr && (best == nullptr || time(*row)->ns < time(*best)->ns)) best = row;
  }
  return best;
}

SuiteRow row_for(const MeasuredCell& cell, Caches caches, const std::string& ours, const ResultRow* form,
                 const IsOurs& is_ours) {
  SuiteRow row;
  row.mesh = cell.mesh;
  row.triangles = cell.triangles;
  row.cell = cell.cell;
  row.caches = caches;
  row.ours = ours;
  row.conclusive = cell.conclusive;
  row.status = cell.rows.empty() ? "not measured" : form == nullptr ? "no answer" : "ok";
  if (form == nullptr) return row;
  const TimesOf times = times_of(caches);
  row.floor_ns = floor_of(cell.rows, times.floor);
  const Field field(cell, is_ours, times.floor != nullptr, row.floor_ns);
  row.form = form->contestant();
  row.steps = form->steps;
  row.mean = field.standing(form, times.mean, false);
  row.tail = field.standing(form, times.tail, true);
  row.build_ms = form->build_ms;
  row.bytes = form->bytes;
  return row;
}

}  // namespace

double above_floor(double ns, double floor) { return std::max(ns - floor, 1.0); }

std::string SuiteRow::question() const {
  return fmt::format("{}, {} within {}, {}", cell.trajectory, workload::name_of(cell.query), cell.reach,
                     name_of(caches));
}

std::vector<SuiteRow> score(const MeasuredCell& cell, const std::vector<std::string>& ours,
                            const IsOurs& is_ours) {
  std::vector<SuiteRow> rows;
  for (const Caches caches : {Caches::warm, Caches::l2, Caches::cold}) {
    if ((caches == Caches::l2 && !cell.cell.l2) || (caches == Caches::cold && !cell.cell.cold)) continue;
    const TimeOf time = times_of(caches).mean;
    for (const std::string& contestant : ours)
      rows.push_back(row_for(cell, caches, contestant, row_of(cell.rows, contestant, time), is_ours));
    rows.push_back(row_for(cell, caches, best_of_ours, fastest_of(cell.rows, ours, time), is_ours));
  }
  return rows;
}

std::optional<Summary> summary_of(const std::vector<const SuiteRow*>& rows, RivalOf rival) {
  Summary summary;
  std::vector<double> ratios;
  double logarithms = 0;
  for (const SuiteRow* const row : rows) {
    const std::optional<Rival>& found = rival(*row);
    if (!found) continue;
    ratios.push_back(found->ratio);
    logarithms += std::log(found->ratio);
    if (found->is_ahead()) ++summary.behind;
    if (!found->is_ahead() && !found->is_behind()) ++summary.undecided;
    if (summary.worst_row == nullptr || found->ratio < summary.worst) {
      summary.worst = found->ratio;
      summary.worst_row = row;
    }
  }
  if (ratios.empty()) return std::nullopt;
  summary.cells = ratios.size();
  summary.geometric_mean = std::exp(logarithms / static_cast<double>(ratios.size()));
  summary.median = support::median(ratios);
  return summary;
}

const std::optional<Rival>& exact_mean(const SuiteRow& row) { return row.mean.exact; }
const std::optional<Rival>& any_mean(const SuiteRow& row) { return row.mean.any; }
const std::optional<Rival>& exact_tail(const SuiteRow& row) { return row.tail.exact; }
const std::optional<Rival>& any_tail(const SuiteRow& row) { return row.tail.any; }

}  // namespace touchmark::bench::experiments::suite
