#include "bench/experiments/suite/suite_score.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/support/median.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::suite {
namespace {

using measurement::ResultRow;
using TimeOf = std::optional<double> (*)(const ResultRow& row);

std::optional<double> warm_mean(const ResultRow& row) {
  if (!row.throughput) return std::nullopt;
  return row.throughput->undisturbed.ns;
}
std::optional<double> warm_tail(const ResultRow& row) { return measurement::p999_of(row, row.latency); }
std::optional<double> cold_median(const ResultRow& row) {
  if (!row.cold) return std::nullopt;
  return row.cold->p50;
}
std::optional<double> cold_tail(const ResultRow& row) {
  if (!row.cold || row.cold->samples < measurement::samples_for_p99) return std::nullopt;
  return row.cold->p99;
}

bool is_right(const ResultRow& row) { return row.status == "ok" && !row.violates_guarantee(); }

/// The rivals of one cell and kind of time, and who of ours is measured against them.
class Field {
 public:
  Field(const std::vector<ResultRow>& rows, const IsOurs& is_ours) : rows_(rows), is_ours_(is_ours) {}

  Standing standing(const ResultRow* ours, TimeOf time) const {
    Standing standing;
    if (ours == nullptr || !time(*ours) || !(*time(*ours) > 0)) return standing;
    standing.ns = time(*ours);
    standing.exact = fastest(time, *standing.ns, true);
    standing.any = fastest(time, *standing.ns, false);
    return standing;
  }

 private:
  std::optional<Rival> fastest(TimeOf time, double ours_ns, bool exact) const {
    const ResultRow* best = nullptr;
    for (const ResultRow& row : rows_) {
      if (is_ours_(row.detector) || row.status != "ok" || !time(row)) continue;
      if (exact && !(row.claims_exactness() && is_right(row))) continue;
      if (best == nullptr || *time(row) < *time(*best)) best = &row;
    }
    if (best == nullptr) return std::nullopt;
    return Rival{best->contestant(), *time(*best), *time(*best) / ours_ns, best->build_ms, best->bytes};
  }

  const std::vector<ResultRow>& rows_;
  const IsOurs& is_ours_;
};

const ResultRow* row_of(const std::vector<ResultRow>& rows, const std::string& contestant, TimeOf time) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ResultRow& row) {
    return row.contestant() == contestant && is_right(row) && time(row);
  });
  return found == rows.end() ? nullptr : &*found;
}

const ResultRow* fastest_of(const std::vector<ResultRow>& rows, const std::vector<std::string>& ours,
                            TimeOf time) {
  const ResultRow* best = nullptr;
  for (const std::string& contestant : ours) {
    const ResultRow* const row = row_of(rows, contestant, time);
    if (row != nullptr && (best == nullptr || *time(*row) < *time(*best))) best = row;
  }
  return best;
}

SuiteRow row_for(const MeasuredCell& cell, bool cold, const std::string& ours, const ResultRow* form,
                 const IsOurs& is_ours) {
  SuiteRow row;
  row.mesh = cell.mesh;
  row.triangles = cell.triangles;
  row.cell = cell.cell;
  row.cell.cold = cold;
  row.ours = ours;
  row.conclusive = cell.conclusive;
  row.status = cell.rows.empty() ? "not measured" : form == nullptr ? "no answer" : "ok";
  if (form == nullptr) return row;
  const Field field(cell.rows, is_ours);
  row.form = form->contestant();
  row.steps = form->steps;
  row.mean = field.standing(form, cold ? cold_median : warm_mean);
  row.tail = field.standing(form, cold ? cold_tail : warm_tail);
  row.build_ms = form->build_ms;
  row.bytes = form->bytes;
  return row;
}

template <std::optional<Rival> Standing::*rival, Standing SuiteRow::*standing>
std::optional<double> ratio_of(const SuiteRow& row) {
  const std::optional<Rival>& found = row.*standing.*rival;
  if (!found) return std::nullopt;
  return found->ratio;
}

}  // namespace

std::string SuiteRow::question() const {
  return fmt::format("{}, {} within {}, {}", cell.trajectory, workload::name_of(cell.query), cell.reach,
                     cell.cold ? "cold" : "warm");
}

std::vector<SuiteRow> score(const MeasuredCell& cell, const std::vector<std::string>& ours,
                            const IsOurs& is_ours) {
  std::vector<SuiteRow> rows;
  for (const bool cold : {false, true}) {
    if (cold && !cell.cell.cold) continue;
    const TimeOf time = cold ? cold_median : warm_mean;
    for (const std::string& contestant : ours)
      rows.push_back(row_for(cell, cold, contestant, row_of(cell.rows, contestant, time), is_ours));
    rows.push_back(row_for(cell, cold, best_of_ours, fastest_of(cell.rows, ours, time), is_ours));
  }
  return rows;
}

std::optional<Summary> summary_of(const std::vector<SuiteRow>& rows, const std::string& ours, RatioOf ratio) {
  Summary summary;
  std::vector<double> ratios;
  double logarithms = 0;
  for (const SuiteRow& row : rows) {
    const std::optional<double> found = row.ours == ours ? ratio(row) : std::nullopt;
    if (!found) continue;
    ratios.push_back(*found);
    logarithms += std::log(*found);
    if (*found < 1) ++summary.lost;
    if (summary.worst_row == nullptr || *found < summary.worst) {
      summary.worst = *found;
      summary.worst_row = &row;
    }
  }
  if (ratios.empty()) return std::nullopt;
  summary.cells = ratios.size();
  summary.geometric_mean = std::exp(logarithms / static_cast<double>(ratios.size()));
  summary.median = support::median(ratios);
  return summary;
}

std::optional<double> exact_mean(const SuiteRow& row) {
  return ratio_of<&Standing::exact, &SuiteRow::mean>(row);
}
std::optional<double> any_mean(const SuiteRow& row) { return ratio_of<&Standing::any, &SuiteRow::mean>(row); }
std::optional<double> exact_tail(const SuiteRow& row) {
  return ratio_of<&Standing::exact, &SuiteRow::tail>(row);
}
std::optional<double> any_tail(const SuiteRow& row) { return ratio_of<&Standing::any, &SuiteRow::tail>(row); }

}  // namespace touchmark::bench::experiments::suite
