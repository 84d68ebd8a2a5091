#include "bench/experiments/papers/tuning.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/papers/choi_sung/surface_measures.h"

namespace touchmark::bench::experiments::papers {

bool holds_rate(const FrontierPoint& point, double rate) {
  return point.ns_p99 && *point.ns_p99 * rate <= 1e9;
}

namespace {

bool is_published(const FrontierPoint& point) { return point.form == "scan" || point.form == "fast level"; }

std::optional<FrontierPoint> chosen(const std::vector<FrontierPoint>& points, double rate, bool published) {
  double least = std::numeric_limits<double>::infinity();
  const auto counts = [&](const FrontierPoint& p) {
    return is_published(p) == published && holds_rate(p, rate);
  };
  for (const FrontierPoint& point : points)
    if (counts(point)) least = std::min(least, point.error.mean);
  std::optional<FrontierPoint> kept;
  const auto better = [](const FrontierPoint& a, const FrontierPoint& b) {
    return std::tie(a.triangles, a.ns, a.error.mean) < std::tie(b.triangles, b.ns, b.error.mean);
  };
  for (const FrontierPoint& point : points) {
    if (!counts(point) || point.error.mean > simpler_within * least) continue;
    if (!kept || better(point, *kept)) kept = point;
  }
  return kept;
}

/// What the points of a level have in common.
struct LevelSummary {
  double min_error = std::numeric_limits<double>::infinity();
  std::size_t triangles = 0;
  bool holds = false;  ///< does any form hold the rate?
};

LevelSummary summary_of(const FrontierResult& result, int level, double rate) {
  LevelSummary summary;
  for (const FrontierPoint& point : result.points) {
    if (point.level != level) continue;
    summary.triangles = std::max(summary.triangles, point.triangles);
    if (!holds_rate(point, rate)) continue;
    summary.holds = true;
    summary.min_error = std::min(summary.min_error, point.error.mean);
  }
  return summary;
}

/// Why no level beyond this one should be tried; empty: one should.
std::string reason_to_stop(const FrontierResult& result, int level, double rate) {
  constexpr int deepest = 8;
  const LevelSummary last = summary_of(result, level, rate), before = summary_of(result, level - 1, rate);
  if (!result.left_out.empty()) return "it was left out: " + result.left_out.back();
  if (!last.holds) return fmt::format("no form of level {} holds the rate", level);
  if (last.triangles == before.triangles) return fmt::format("level {} has no edge left to split", level);
  if (!(last.min_error < before.min_error))
    return fmt::format("level {} is no nearer to the reference", level);
  if (result.reference_levels > 0 && level + 1 >= result.reference_levels)
    return fmt::format("level {} would be the reference itself: --reference names a finer one", level + 1);
  if (level >= deepest) return fmt::format("level {} is the last that is tried", deepest);
  return "";
}

}  // namespace

Tuned tune(const FrontierResult& result, double rate) {
  return {chosen(result.points, rate, true), chosen(result.points, rate, false)};
}

LevelSearch search_levels(const TriangleMesh& mesh, FrontierSettings settings, double rate, bool all,
                          const PrintProgress& print_progress) {
  // A level is judged by a finer one.
  if (!all && settings.reference_levels == 0) settings.reference_levels = settings.levels + 3;
  LevelSearch search{run_frontier(mesh, settings, print_progress), "no more were asked for"};
  settings.reference_levels = search.result.reference_levels;
  for (int level = settings.levels; !all && search.result.finished; ++level) {
    search.stopped = reason_to_stop(search.result, level, rate);
    if (!search.stopped.empty()) break;
    settings.first_level = settings.levels = level + 1;
    FrontierResult finer = run_frontier(mesh, settings, print_progress);
    search.result.finished = finer.finished;
    search.result.left_out = std::move(finer.left_out);
    search.result.points.insert(search.result.points.end(), finer.points.begin(), finer.points.end());
  }
  mark_best(search.result.points, [](const FrontierPoint&) { return true; });
  return search;
}

SharpEdges sharp_edges(const TriangleMesh& mesh) {
  constexpr double sharp_deg = 60, flat_deg = 1;
  SharpEdges sharp;
  double length = 0;
  each_crease(mesh, [&](double edge, double angle) {
    const double deg = angle * 180 / std::numbers::pi;
    if (deg > flat_deg) length += edge;
    if (deg <= sharp_deg) return;
    ++sharp.count;
    sharp.share += edge;
  });
  if (length > 0) sharp.share /= length;
  return sharp;
}

std::string rising_error_note(const FrontierResult& result) {
  const FrontierPoint* last = nullptr;
  for (const FrontierPoint& point : result.points) {
    if (point.form != "scan" || point.clustering != 0) continue;
    if (last != nullptr && last->method == point.method && last->level + 1 == point.level &&
        point.error.mean > 1.01 * last->error.mean)
      return fmt::format(
          "The error rises from level {} to level {} of {}: at a fixed threshold only the long edges split, "
          "but the vertices of short ones move at every level, too, and go on past the surface that "
          "splitting them would lead to. A smaller --threshold moves that level up; fewer levels avoid it.",
          last->level, point.level, point.method);
    last = &point;
  }
  return "";
}

std::string detector_of(const FrontierPoint& point) {
  if (point.form == "grid") return "grid-group";
  if (point.form == "tree") return "sphere-cluster";
  std::string text = "sphere-cluster:lookup=scan";
  if (point.clustering > 0) text += fmt::format(",clustering={:.6g}", point.clustering);
  if (point.form == "fast level") text += ",precise=false";
  return text;
}

}  // namespace touchmark::bench::experiments::papers
