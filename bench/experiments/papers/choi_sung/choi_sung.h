/// The experiment of Choi & Sung, PLoS ONE 12(9), 2017: five subdivision methods, three levels, bounding
/// spheres with and without clustering, and what a haptic query costs on each (their Table 1 and Figs 2-11).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/papers/choi_sung/sphere_partitions.h"
#include "bench/experiments/papers/choi_sung/surface_measures.h"
#include "bench/experiments/papers/interleaved_timing.h"
#include "bench/experiments/papers/paper_meshes.h"
#include "core/sphere_cluster/clustering.h"
#include "core/subdivision/subdivision.h"

namespace touchmark::bench::experiments::papers {

/// In the paper's order, each as its tool applied it.
inline constexpr std::array<SubdivisionMethod, 5> choi_sung_methods{
    SubdivisionMethod::butterfly, SubdivisionMethod::catmull_clark_linear, SubdivisionMethod::mid_point,
    SubdivisionMethod::loop, SubdivisionMethod::ls3};

/// The paper's 0.02 for the clustering distance, in percent of the box diagonal: 0.0420 mesh units, triangles
/// visited breadth-first, make 728 spheres of its 902 triangles, as printed, and come nearest to its other
/// counts.
inline constexpr double choi_sung_clustering_percent = 1.606;
/// MeshLab's edge threshold, in percent of level 0's box diagonal.
inline constexpr double choi_sung_threshold_percent = 1;

struct ChoiSungSettings {
  int levels = 3;
  std::size_t steps = 2000;
  std::uint64_t seed = 1;
  double radius = 0;      ///< the probe's, mesh units
  double clustering = 0;  ///< distance, mesh units
  bool timed = true;      ///< false: counts alone
  VisitOrder order = VisitOrder::breadth_first;
  TimingEffort effort;
};

/// One row of Table 1.
struct ChoiSungRow {
  SurfaceMeasures surface;
  double clustering = 0;  ///< mesh units; 0: without
  std::size_t spheres = 0;
  double tightness = 0;           ///< mesh units, the paper's formula
  double relative_tightness = 1;  ///< to level 0 without clustering
  /// The mean of (radius - distance) / radius over the same pairs, to level 0 without clustering.
  double relative_looseness = 1;
  std::optional<PartitionTightness> partitions = {};  ///< empty in rows without clustering
  // Empty until timed. The published two-level scan, and what may replace it: exact, too.
  std::optional<TimedTurns> scan, tree;
  std::optional<TimedTurns> grid;  ///< knows no clustering: of unclustered rows only
  std::optional<TimedTurns> fast;  ///< level 1 alone: the spheres and no triangle
  /// Steps of the slide over level 0 that touch this surface, too.
  std::size_t contacts_of_original_path = 0;
};

/// What a distance of clustering makes of one surface.
struct DistanceRow {
  std::string mesh;  ///< "paper", or the name of another model
  std::string method;
  int level = 0;
  double clustering = 0;  ///< mesh units
  std::size_t spheres = 0;
  double tests_per_query = 0;  ///< spheres and triangles
  std::optional<double> ns = {};
  std::optional<double> mean_error = {};  ///< how far the triangles are from the smooth surface, mesh units
};

/// One of the paper's statements on another model than its bunny.
struct ModelVerdict {
  std::string model;
  std::size_t triangles = 0;  ///< how many its level 0 has
  std::string where, what;    ///< as in the list of claims
  bool holds = false;
  std::string reproduced;
};

struct ChoiSungResult {
  std::vector<ChoiSungRow> rows;  ///< level 0 first, then by method and level; without clustering, then with
  std::size_t steps = 0;          ///< how many each surface's slide has
  std::vector<DistanceRow> distances;  ///< empty until filled (choi_sung_models.h)
  std::vector<ModelVerdict> models;    ///< empty until filled
  bool answers_agree = true;           ///< did all exact forms answer alike on every surface?
  bool finished = false;               ///< false: interrupted
};

/// Called with what is being done.
using PrintProgress = std::function<void(const std::string& what)>;

/// Surface k of a method: MeshLab's way, with the paper's threshold.
TriangleMesh choi_sung_surface(const TriangleMesh& original, SubdivisionMethod method, int level);

/// Given each surface and its clusters (distance 0 and the settings'), in the order of the rows, for drawing.
using SurfaceSink = std::function<void(const SurfaceMeasures&, const TriangleMesh&,
                                       const SphereClusters& single, const SphereClusters& clustered)>;

/// After Ctrl-C the rows that have been measured come back, `finished` false.
ChoiSungResult run_choi_sung(const TriangleMesh& original, const ChoiSungSettings& settings,
                             const SurfaceSink& sink, const PrintProgress& print_progress);

/// The row of a method at a level; level 0 whatever the method. Nothing when it was not reached.
const ChoiSungRow* find_row(const ChoiSungResult& result, SubdivisionMethod method, int level,
                            bool clustered);

}  // namespace touchmark::bench::experiments::papers
