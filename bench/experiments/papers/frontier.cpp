#include "bench/experiments/papers/frontier.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "bench/contestants/contestant_of.h"
#include "bench/experiments/papers/paper_trace.h"
#include "bench/support/failures.h"
#include "bench/support/system/interrupt.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark::bench::experiments::papers {
namespace {

// Farther than any sphere about a triangle reaches.
constexpr double offset_in_diagonals = 0.1;
/// Triangles of the reference: what a second or two can make and search.
constexpr std::size_t max_reference = 2'000'000;

class Exploration {
 public:
  Exploration(const TriangleMesh& original, const FrontierSettings& settings,
              const PrintProgress& print_progress)
      : original_(original),
        settings_(settings),
        print_progress_(print_progress),
        trace_(paper_trace("slide", original, settings.steps, settings.seed, settings.radius)),
        timing_(trace_, workload::Query::nearest, settings.seed) {}

  FrontierResult run() {
    try {
      make_reference();
      if (settings_.first_level == 0) add_surface("original", 0, original_);
      for (const SubdivisionMethod method : settings_.methods)
        for (int level = std::max(settings_.first_level, 1); level <= settings_.levels; ++level)
          add_level(method, level);
      timing_.run(settings_.effort, [this](std::size_t round, std::size_t) {
        print_progress_(fmt::format("frontier: timing, round {} of {}", round + 1, settings_.effort.rounds));
      });
      result_.finished = true;
    } catch (const support::Interrupted&) {
    }
    for (std::size_t i = 0; i < result_.points.size(); ++i) {
      const TimedTurns timed = timing_.timed(i);
      if (timed.ns > 0) result_.points[i].ns = timed.ns;
      result_.points[i].ns_p99 = timed.ns_p99;
      result_.points[i].tests_per_query = timed.work;
    }
    return std::move(result_);
  }

 private:
  void make_reference() {
    print_progress_("frontier: the smooth surface");
    const double offset = offset_in_diagonals * original_.diagonal();
    if (settings_.reference) {
      result_.reference_triangles = settings_.reference->size();
      reference_.emplace(*settings_.reference, offset, settings_.samples, settings_.seed);
      return;
    }
    const SmoothSurface smooth = smooth_surface(
        original_, settings_.reference_levels > 0 ? settings_.reference_levels : settings_.levels + 2);
    result_.reference_triangles = smooth.mesh.size();
    result_.reference_levels = smooth.levels;
    reference_.emplace(smooth.mesh, offset, settings_.samples, settings_.seed);
  }

  void add_level(SubdivisionMethod method, int level) {
    std::optional<TriangleMesh> mesh;
    try {
      mesh = subdivide(original_, {.method = method,
                                   .levels = level,
                                   .threshold = settings_.threshold,
                                   .form = SubdivisionForm::meshlab,
                                   .max_triangles = settings_.max_triangles});
    } catch (const MeshError& error) {
      result_.left_out.push_back(fmt::format("{} level {}: {}", name_of(method), level, error.what()));
      return;
    }
    add_surface(name_of(method), level, *mesh);
  }

  void add_surface(std::string_view method, int level, const TriangleMesh& mesh) {
    print_progress_(fmt::format("frontier: {} level {}", method, level));
    paths_.push_back(paper_trace("slide", mesh, settings_.steps, settings_.seed, settings_.radius));
    // Every exact form answers for the same surface, so one error does for all of them.
    const SphereCluster tree = SphereCluster::build(mesh);
    FrontierPoint point{std::string(method),       level, "scan", 0, mesh.size(), mesh.size(),
                        reference_->error_of(tree)};
    for (const double clustering : settings_.clusterings) add_clustering(point, mesh, clustering);
    if (!settings_.fast_forms) return;
    point.form = "tree";
    add(point, tree);
    point.form = "grid";
    add(point, GridGroup::build(mesh));
  }

  void add_clustering(FrontierPoint point, const TriangleMesh& mesh, double clustering) {
    point.clustering = clustering;
    auto scan = PublishedSphereCluster::build(mesh, {.clustering = clustering});
    point.spheres = scan.clusters().size();
    add(point, std::move(scan));
    auto fast = PublishedSphereCluster::build(mesh, {.clustering = clustering, .precise = false});
    point.form = "fast level";
    point.error = reference_->error_of(fast);
    add(point, std::move(fast));
  }

  template <class D>
  void add(const FrontierPoint& point, D detector) {
    timing_.add(std::make_unique<contestants::ContestantOf<D>>(std::move(detector)), paths_.back());
    result_.points.push_back(point);
  }

  const TriangleMesh& original_;
  const FrontierSettings& settings_;
  const PrintProgress& print_progress_;
  std::vector<workload::Step> trace_;
  std::deque<std::vector<workload::Step>> paths_;  // over each surface itself
  InterleavedTiming timing_;
  std::optional<ReferenceSurface> reference_;
  FrontierResult result_;  // point i is the timing's detector i
};

}  // namespace

SmoothSurface smooth_surface(const TriangleMesh& original, int levels) {
  int made = 1;
  for (std::size_t size = 16 * original.size(); made < levels && size <= max_reference; size *= 4) ++made;
  return {subdivide(original,
                    {.method = SubdivisionMethod::ls3, .levels = made, .form = SubdivisionForm::meshlab}),
          made};
}

void mark_best(std::vector<FrontierPoint>& points, const std::function<bool(const FrontierPoint&)>& among) {
  std::vector<FrontierPoint*> compared;
  for (FrontierPoint& point : points) {
    point.best = false;
    if (point.ns && among(point)) compared.push_back(&point);
  }
  std::ranges::sort(compared, [](const FrontierPoint* a, const FrontierPoint* b) {
    return a->ns != b->ns ? a->ns < b->ns : a->error.mean < b->error.mean;
  });
  double least = std::numeric_limits<double>::infinity();
  for (FrontierPoint* point : compared) {
    point->best = point->error.mean < least;
    least = std::min(least, point->error.mean);
  }
}

FrontierResult run_frontier(const TriangleMesh& original, const FrontierSettings& settings,
                            const PrintProgress& print_progress) {
  FrontierResult result = Exploration(original, settings, print_progress).run();
  mark_best(result.points, [](const FrontierPoint&) { return true; });
  return result;
}

support::Table frontier_table(const FrontierResult& result, double diagonal) {
  support::Table table({"method", "level", "form", "clustering", "triangles", "spheres", "mean_error",
                        "rms_error", "max_error", "mean_error_percent", "detection_ms", "update_rate_hz",
                        "on_frontier", "tests_per_query"});
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  for (const FrontierPoint& p : result.points)
    table.add({p.method, std::to_string(p.level), p.form, number(p.clustering), std::to_string(p.triangles),
               std::to_string(p.spheres), number(p.error.mean), number(p.error.rms), number(p.error.max),
               number(diagonal > 0 ? 100 * p.error.mean / diagonal : 0), p.ns ? number(*p.ns * 1e-6) : "",
               p.ns ? number(1e9 / *p.ns) : "", p.best ? "yes" : "no",
               fmt::format("{:.1f}", p.tests_per_query)});
  return table;
}

}  // namespace touchmark::bench::experiments::papers
