#include "bench/experiments/papers/choi_sung.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "bench/contestants/entry.h"
#include "bench/experiments/papers/paper_trace.h"
#include "bench/scenes/welded_mesh.h"
#include "bench/support/available_memory.h"
#include "bench/support/failures.h"
#include "bench/support/interrupt.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/published/triangle_spheres.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "core/subdivision/mesh_measures.h"

namespace touchmark::bench::experiments::papers {
namespace {

/// object.position in the paper's volume: the origin, unless the mesh lies elsewhere.
Vec3 volume_center(const TriangleMesh& original) {
  const Aabb& box = original.bounds();
  return box.contains(Vec3::Zero()) ? Vec3(Vec3::Zero()) : Vec3(box.center());
}

double tightness_of(const TriangleMesh& mesh, const SphereClusters& clusters) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const Sphere& sphere : clusters.spheres) {
    centers.push_back(sphere.center);
    radii.push_back(sphere.radius);
  }
  return tightness(centers, radii, centroids(mesh)).value_or(0);
}

Vec3 face_normal(const TriangleMesh& mesh, std::uint32_t triangle) {
  const Vec3& a = mesh.corner(triangle, 0);
  return (mesh.corner(triangle, 1) - a).cross(mesh.corner(triangle, 2) - a).stableNormalized();
}

/// How creased the surface looks. Smooth ones halve it with every level, flat facets stay creased.
double crease_deg(const TriangleMesh& mesh) {
  const scenes::WeldedMesh welded(mesh);
  double sum = 0, length = 0;
  welded.each_edge([&](std::span<const scenes::TriangleSide> sides) {
    if (sides.size() != 2) return;
    const Vec3 a = face_normal(mesh, sides[0].triangle), b = face_normal(mesh, sides[1].triangle);
    const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
    const double edge = (welded.nodes[sides[0].low] - welded.nodes[sides[0].high]).norm();
    sum += edge * angle * angle;
    length += edge;
  });
  return length > 0 ? std::sqrt(sum / length) * 180 / std::numbers::pi : 0;
}

/// Which detectors of the timing belong to a row.
struct Numbers {
  std::size_t scan = 0, tree = 0;
  std::optional<std::size_t> grid;
};

class Experiment {
 public:
  Experiment(const TriangleMesh& original, const ChoiSungSettings& settings, const SurfaceSink& sink,
             const PrintProgress& print_progress)
      : original_(original),
        settings_(settings),
        sink_(sink),
        print_progress_(print_progress),
        trace_(paper_trace("slide", original, settings.steps, settings.seed, settings.radius)),
        timing_(trace_, workload::Query::nearest, settings.seed) {}

  ChoiSungResult run() {
    try {
      measure_surface("original", 0, original_);
      for (const SubdivisionMethod method : choi_sung_methods) {
        for (int level = 1; level <= settings_.levels; ++level)
          measure_surface(name_of(method), level, choi_sung_surface(original_, method, level));
      }
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
    SurfaceMeasures surface{std::string(method), level, mesh.size(), mean_triangle_area(mesh)};
    const double volume = absolute_volume(mesh, volume_center(original_));
    if (level == 0) original_volume_ = volume;
    surface.relative_volume = volume / original_volume_;
    surface.crease_deg = crease_deg(mesh);
    const SphereClusters single = cluster_spheres(mesh, 0);
    const SphereClusters clustered = cluster_spheres(mesh, settings_.clustering, settings_.order);
    sink_(surface, mesh, single, clustered);
    measure_spheres(surface, mesh, single, 0);
    measure_spheres(surface, mesh, clustered, settings_.clustering);
  }

  void measure_spheres(const SurfaceMeasures& surface, const TriangleMesh& mesh,
                       const SphereClusters& clusters, double clustering) {
    using Lookup = SphereCluster::Lookup;
    ChoiSungRow row{surface, clustering, clusters.size(), tightness_of(mesh, clusters), 1, {}, {}, {}};
    if (original_tightness_ == 0) original_tightness_ = row.tightness;
    row.relative_tightness = original_tightness_ > 0 ? row.tightness / original_tightness_ : 1;
    Numbers numbers;
    const auto spheres = [&](Lookup lookup) {
      return timing_.add(contestants::contestant<SphereCluster>(
          mesh, {.clustering = clustering, .lookup = lookup, .order = settings_.order}));
    };
    numbers.scan = spheres(Lookup::scan);
    numbers.tree = spheres(Lookup::tree);
    if (clustering == 0) numbers.grid = timing_.add(contestants::contestant<GridGroup>(mesh, {}));
    check_answers(numbers);
    result_.rows.push_back(std::move(row));
    numbers_.push_back(numbers);
  }

  void check_answers(const Numbers& numbers) {
    const std::uint64_t expected = timing_.timed(numbers.scan).answers;
    const bool same = timing_.timed(numbers.tree).answers == expected &&
                      (!numbers.grid || timing_.timed(*numbers.grid).answers == expected);
    result_.answers_agree = result_.answers_agree && same;
  }

  void fill_times(ChoiSungRow& row, const Numbers& numbers) const {
    row.scan = timing_.timed(numbers.scan);
    row.tree = timing_.timed(numbers.tree);
    if (numbers.grid) row.grid = timing_.timed(*numbers.grid);
  }

  const TriangleMesh& original_;
  const ChoiSungSettings& settings_;
  const SurfaceSink& sink_;
  const PrintProgress& print_progress_;
  std::vector<workload::Step> trace_;
  InterleavedTiming timing_;
  ChoiSungResult result_;
  std::vector<Numbers> numbers_;  // one a row
  double original_volume_ = 0, original_tightness_ = 0;
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
  const auto found = std::find_if(result.rows.begin(), result.rows.end(), [&](const ChoiSungRow& row) {
    return row.surface.level == level && (row.clustering > 0) == clustered &&
           (level == 0 || row.surface.method == name_of(method));
  });
  return found == result.rows.end() ? nullptr : &*found;
}

}  // namespace touchmark::bench::experiments::papers
