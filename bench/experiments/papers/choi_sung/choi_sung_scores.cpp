#include "bench/experiments/papers/choi_sung/choi_sung_scores.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace touchmark::bench::experiments::papers {
namespace {

int levels_of(const ChoiSungResult& result) {
  int levels = 0;
  for (const ChoiSungRow& row : result.rows) levels = std::max(levels, row.surface.level);
  return levels;
}

/// The mean over levels 1 and up of value(row at the level, row at level 0).
using Value = std::function<double(const ChoiSungRow& row, const ChoiSungRow& original)>;
double mean_over_levels(const ChoiSungResult& result, SubdivisionMethod method, bool clustered,
                        const Value& value) {
  const ChoiSungRow& original = *find_row(result, method, 0, clustered);
  double sum = 0;
  const int levels = levels_of(result);
  for (int level = 1; level <= levels; ++level)
    sum += value(*find_row(result, method, level, clustered), original);
  return sum / levels;
}

/// A criterion's value for each method, the less the better; `both`: the mean of without and with clustering.
std::vector<double> badness(const ChoiSungResult& result, bool both, const Value& value) {
  std::vector<double> values;
  for (const SubdivisionMethod method : choi_sung_methods) {
    double mean = mean_over_levels(result, method, false, value);
    if (both) mean = (mean + mean_over_levels(result, method, true, value)) / 2;
    values.push_back(mean);
  }
  return values;
}

}  // namespace

std::vector<double> scores_of(const std::vector<double>& badness) {
  const auto [least, greatest] = std::ranges::minmax_element(badness);
  std::vector<double> scores;
  scores.reserve(badness.size());
  for (const double value : badness)
    scores.push_back(*greatest > *least ? 5 * (*greatest - value) / (*greatest - *least) : 5);
  return scores;
}

std::vector<MethodScores> choi_sung_scores(const ChoiSungResult& result) {
  if (!result.finished || levels_of(result) == 0 || result.rows.front().scan->ns <= 0) return {};
  const auto score = [&result](bool both, const Value& value) {
    return scores_of(badness(result, both, value));
  };
  using Row = ChoiSungRow;
  const auto creases = score(false, [](const Row& row, const Row&) { return row.surface.crease_deg; });
  const auto closeness = score(false, [](const Row& row, const Row&) { return row.surface.vertex_offset; });
  const auto volume =
      score(false, [](const Row& row, const Row&) { return std::abs(row.surface.relative_volume - 1); });
  const auto tight = score(false, [](const Row& row, const Row&) { return row.relative_tightness; });
  const auto detection =
      score(true, [](const Row& row, const Row& original) { return row.scan->ns / original.scan->ns; });
  const auto update =
      score(true, [](const Row& row, const Row& original) { return -original.scan->ns / row.scan->ns; });
  std::vector<MethodScores> scores;
  for (std::size_t i = 0; i < choi_sung_methods.size(); ++i)
    scores.push_back({choi_sung_methods[i], (creases[i] + closeness[i]) / 2, volume[i], tight[i],
                      detection[i], update[i], creases[i], closeness[i]});
  return scores;
}

}  // namespace touchmark::bench::experiments::papers
