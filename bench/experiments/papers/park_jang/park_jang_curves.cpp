/// Fig. 7's curves by operations per query: where they reach a tenth, where they are lowest, where they rise
/// again.
#include <algorithm>
#include <cmath>
#include <functional>

#include "bench/experiments/papers/park_jang/park_jang.h"

namespace touchmark::bench::experiments::papers {
namespace {

double mean_operations(const ParkJangRow& row) { return operations_of(row, row.counted.mean); }

using Rows = std::vector<const ParkJangRow*>;

/// The number of groups at which the curve between two rows has this many operations.
double groups_at(const ParkJangRow& a, const ParkJangRow& b, double operations) {
  const double from = std::log(mean_operations(a)), to = std::log(mean_operations(b));
  const double part = from == to ? 0 : (std::log(operations) - from) / (to - from);
  const double groups = std::log(static_cast<double>(a.groups));
  return std::exp(groups + part * (std::log(static_cast<double>(b.groups)) - groups));
}

std::size_t min_at(const Rows& rows, const std::function<double(const ParkJangRow&)>& value) {
  const auto least =
      std::ranges::min_element(rows, [&](const auto* a, const auto* b) { return value(*a) < value(*b); });
  return static_cast<std::size_t>(least - rows.begin());
}

/// The middle half of the places by their own best counts.
void fill_places(const Rows& rows, ParkJangCurve& curve) {
  std::vector<std::size_t> best;
  for (std::size_t place = 0; place < rows.front()->counted.by_place.size(); ++place)
    best.push_back(rows[min_at(rows, [&](const ParkJangRow& row) {
                     return operations_of(row, row.counted.by_place[place]);
                   })]->groups);
  if (best.empty()) return;
  std::ranges::sort(best);
  curve.best_of_places_from = best[best.size() / 4];
  curve.best_of_places_to = best[best.size() - 1 - best.size() / 4];
}

ParkJangCurve curve_of(const Rows& rows, double ungrouped) {
  const std::size_t least = min_at(rows, mean_operations);
  const double min_operations = mean_operations(*rows[least]);
  ParkJangCurve curve;
  curve.mesh = rows[0]->mesh;
  curve.triangles = rows[0]->triangles;
  curve.shape = rows[0]->form;
  curve.best = rows[least]->groups;
  curve.factor = min_operations > 0 ? ungrouped / min_operations : 0;
  for (std::size_t i = least; i > 0 && !curve.tenth_from && min_operations <= ungrouped / 10; --i)
    if (mean_operations(*rows[i - 1]) > ungrouped / 10)
      curve.tenth_from = groups_at(*rows[i - 1], *rows[i], ungrouped / 10);
  for (std::size_t i = least; i + 1 < rows.size() && !curve.rises_from; ++i)
    if (mean_operations(*rows[i + 1]) > 1.1 * min_operations)
      curve.rises_from = groups_at(*rows[i], *rows[i + 1], 1.1 * min_operations);
  fill_places(rows, curve);
  return curve;
}

}  // namespace

double operations_of(const ParkJangRow& row, double tests) {
  if (row.form == "direct") return 0;
  const auto groups = static_cast<double>(row.groups);
  return groups * (row.form == "cube" ? cuboid_operations : sphere_operations) +
         (tests - groups) * triangle_operations;
}

std::vector<ParkJangCurve> park_jang_curves(const ParkJangResult& result) {
  std::vector<ParkJangCurve> curves;
  Rows rows;
  double ungrouped = 0;
  const auto finish = [&] {
    if (rows.size() > 1 && ungrouped > 0) curves.push_back(curve_of(rows, ungrouped));
    rows.clear();
  };
  for (const ParkJangRow& row : result.rows) {
    if (!rows.empty() && (rows[0]->mesh != row.mesh || rows[0]->form != row.form)) finish();
    if (row.form == "ungrouped") ungrouped = mean_operations(row);
    if (row.groups > 0 && row.counted.mean > 0) rows.push_back(&row);
  }
  finish();
  return curves;
}

}  // namespace touchmark::bench::experiments::papers
