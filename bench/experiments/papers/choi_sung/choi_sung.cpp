#include "bench/experiments/papers/choi_sung/choi_sung.h"

#include <algorithm>
#include <deque>
#include <utility>

#include <fmt/format.h>

#include "bench/contestants/entry.h"
#include "bench/experiments/papers/paper_trace.h"
#include "bench/support/failures.h"
#include "bench/support/system/available_memory.h"
#include "bench/support/system/interrupt.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"
#include "core/sphere_cluster/published/triangle_spheres.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "core/subdivision/mesh_measures.h"

namespace touchmark::bench::experiments::papers {
namespace {

/// Both readings of the paper's formula.
struct Tightness {
  double absolute = 0, scale_free = 0;
};

Tightness tightness_of(const TriangleMesh& mesh, const SphereClusters& clusters) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const Sphere& sphere : clusters.spheres) {
    centers.push_back(sphere.center);
    radii.push_back(sphere.radius);
  }
  const std::vector<Vec3> middles = centroids(mesh);
  const double absolute = tightness(centers, radii, middles).value_or(0);
  // Mid-point's neighbours lie on the spheres, so here it matters that the detector's radii are rounded up.
  for (std::size_t i = 0; i < radii.size() && clusters.size() == mesh.size(); ++i) {
    radii[i] = 0;
    for (int k = 0; k < 3; ++k) radii[i] = std::max(radii[i], (mesh.corner(i, k) - centers[i]).norm());
  }
  return {absolute, scale_free_tightness(centers, radii, middles).value_or(0)};
}

/// Catmull-Clark with each level's quadrilaterals cut before the next, as a file of triangles between two
/// levels makes it: six triangles of each, not four. Fig. 6 comes out with these.
TriangleMesh cut_between_levels(const TriangleMesh& original, int levels) {
  TriangleMesh mesh = original;
  for (int level = 0; level < levels; ++level)
    mesh = choi_sung_surface(mesh, SubdivisionMethod::catmull_clark_linear, 1);
  return mesh;
}

/// Which detectors of the timing belong to a row.
struct Numbers {
  std::size_t scan = 0;
  std::optional<std::size_t> tree, fast, grid;
};

class Experiment {
 public:
  Experiment(const TriangleMesh& original, const ChoiSungSettings& settings, const SurfaceSink& sink,
             const PrintProgress& print_progress)
      : original_(original),
        settings_(settings),
        sink_(sink),
        print_progress_(print_progress),
        ruler_(original),
        original_path_(paper_trace("slide", original, settings.steps, settings.seed, settings.radius)),
        timing_(original_path_, workload::Query::nearest, settings.seed) {
    result_.steps = settings.steps;
  }

  ChoiSungResult run() {
    try {
      measure_surface("original", 0, original_);
      for (const SubdivisionMethod method : choi_sung_methods)
        for (int level = 1; level <= settings_.levels; ++level)
          measure_surface(name_of(method), level, choi_sung_surface(original_, method, level));
      if (settings_.timed)
        timing_.run(settings_.effort, [this](std::size_t round, std::size_t) {
          print_progress_(fmt::format("timing, round {} of {}", round + 1, settings_.effort.rounds));
        });
      result_.finished = true;
    } catch (const support::Interrupted&) {
    }
    for (std::size_t i = 0; i < result_.rows.size(); ++i) fill_times(result_.rows[i], numbers_[i]);
    return std::move(result_);
  }

 private:
  void measure_surface(std::string_view method, int level, const TriangleMesh& mesh) {
    print_progress_(fmt::format("{} level {}: {} triangles", method, level, mesh.size()));
    support::require_memory_for_triangles(mesh.size(), support::min_bytes_per_triangle);
    const SurfaceMeasures surface = ruler_.measure(std::string(method), level, mesh);
    const SphereClusters single = cluster_spheres(mesh, 0);
    const SphereClusters clustered = cluster_spheres(mesh, settings_.clustering, settings_.order);
    sink_(surface, mesh, single, clustered);
    // Over each surface itself: a path along level 0 leaves a shrunken one, and free motion is cheap.
    paths_.push_back(paper_trace("slide", mesh, settings_.steps, settings_.seed, settings_.radius));
    ChoiSungRow row;
    row.surface = surface;
    if (settings_.timed) row.contacts_of_original_path = contacts_of_original_path(mesh);
    measure_spheres(row, mesh, single);
    row.clustering = settings_.clustering;
    measure_spheres(row, mesh, clustered);
  }

  void measure_spheres(ChoiSungRow row, const TriangleMesh& mesh, const SphereClusters& clusters) {
    row.spheres = clusters.size();
    const Tightness tightness = tightness_of(mesh, clusters);
    row.tightness = tightness.absolute;
    if (original_tightness_.absolute == 0) original_tightness_ = tightness;
    if (original_tightness_.absolute > 0) {
      row.relative_tightness = row.tightness / original_tightness_.absolute;
      row.relative_looseness = looseness_of(row, tightness.scale_free);
    }
    if (row.clustering > 0) row.partitions = partition_tightness(mesh, clusters);
    const Numbers numbers = add_detectors(mesh, row.clustering);
    check_answers(numbers);
    result_.rows.push_back(std::move(row));
    numbers_.push_back(numbers);
  }

  double looseness_of(const ChoiSungRow& row, double scale_free) const {
    const bool cut =
        row.surface.method == name_of(SubdivisionMethod::catmull_clark_linear) && row.surface.level > 1;
    if (cut && row.clustering == 0) {
      const TriangleMesh finer = cut_between_levels(original_, row.surface.level);
      scale_free = tightness_of(finer, cluster_spheres(finer, 0)).scale_free;
    }
    return scale_free / original_tightness_.scale_free;
  }

  Numbers add_detectors(const TriangleMesh& mesh, double clustering) {
    const auto published = [&](bool precise) {
      return timing_.add(
          contestants::contestant<PublishedSphereCluster>(mesh, {clustering, precise, settings_.order}),
          paths_.back());
    };
    Numbers numbers;
    numbers.scan = published(true);
    if (!settings_.timed) return numbers;
    numbers.tree =
        timing_.add(contestants::contestant<SphereCluster>(mesh, {.clustering = clustering}), paths_.back());
    numbers.fast = published(false);
    if (clustering == 0)
      numbers.grid = timing_.add(contestants::contestant<GridGroup>(mesh, {}), paths_.back());
    return numbers;
  }

  std::size_t contacts_of_original_path(const TriangleMesh& mesh) const {
    const SphereCluster tree = SphereCluster::build(mesh);
    SphereCluster::Session session;
    return static_cast<std::size_t>(std::ranges::count_if(original_path_, [&](const workload::Step& step) {
      return tree.nearest(step.probe, step.reach, session).has_value();
    }));
  }

  void check_answers(const Numbers& numbers) {
    const std::uint64_t expected = timing_.timed(numbers.scan).answers;
    for (const auto& other : {numbers.tree, numbers.grid})
      if (other && timing_.timed(*other).answers != expected) result_.answers_agree = false;
  }

  void fill_times(ChoiSungRow& row, const Numbers& numbers) const {
    row.scan = timing_.timed(numbers.scan);
    if (numbers.tree) row.tree = timing_.timed(*numbers.tree);
    if (numbers.fast) row.fast = timing_.timed(*numbers.fast);
    if (numbers.grid) row.grid = timing_.timed(*numbers.grid);
  }

  const TriangleMesh& original_;
  const ChoiSungSettings& settings_;
  const SurfaceSink& sink_;
  const PrintProgress& print_progress_;
  SurfaceRuler ruler_;
  std::vector<workload::Step> original_path_;
  std::deque<std::vector<workload::Step>> paths_;  // a surface each
  InterleavedTiming timing_;
  ChoiSungResult result_;
  std::vector<Numbers> numbers_;  // one a row
  Tightness original_tightness_;
};

}  // namespace

TriangleMesh choi_sung_surface(const TriangleMesh& original, SubdivisionMethod method, int level) {
  return subdivide(original, {.method = method,
                              .levels = level,
                              .threshold = choi_sung_threshold_percent / 100 * original.diagonal(),
                              .form = SubdivisionForm::meshlab});
}

ChoiSungResult run_choi_sung(const TriangleMesh& original, const ChoiSungSettings& settings,
                             const SurfaceSink& sink, const PrintProgress& print_progress) {
  return Experiment(original, settings, sink, print_progress).run();
}

const ChoiSungRow* find_row(const ChoiSungResult& result, SubdivisionMethod method, int level,
                            bool clustered) {
  const auto found = std::ranges::find_if(result.rows, [&](const ChoiSungRow& row) {
    return row.surface.level == level && (row.clustering > 0) == clustered &&
           (level == 0 || row.surface.method == name_of(method));
  });
  return found == result.rows.end() ? nullptr : &*found;
}

}  // namespace touchmark::bench::experiments::papers
