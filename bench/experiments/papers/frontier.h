/// Run time against error as one frontier: what the paper leaves to future work. Every subdivision method and
/// level, every clustering, the fast level alone and the precise one, as published and in the fast exact
/// forms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/papers/choi_sung/choi_sung.h"
#include "bench/experiments/papers/choi_sung/geometric_error.h"
#include "bench/experiments/papers/interleaved_timing.h"
#include "bench/support/table.h"
#include "core/subdivision/subdivision.h"

namespace touchmark::bench::experiments::papers {

struct FrontierSettings {
  std::vector<SubdivisionMethod> methods{choi_sung_methods.begin(), choi_sung_methods.end()};
  int levels = 3;
  int first_level = 0;                         ///< 0: the original, too
  std::optional<TriangleMesh> reference = {};  ///< what is true; nothing: LS3 in place of its limit surface
  int reference_levels =
      0;                 ///< levels of that LS3; 0: two more than `levels`, as far as memory and time allow
  double threshold = 0;  ///< mesh units: edges longer than this split; 0: all do
  std::vector<double> clusterings;  ///< mesh units; 0 among them: a sphere a triangle
  bool fast_forms = true;           ///< the exact tree and grid besides the published scans
  double radius = 0;                ///< the timed probe's, mesh units
  std::size_t steps = 500;
  std::size_t samples = 2000;  ///< points at which the error is measured
  std::uint64_t seed = 1;
  std::size_t max_triangles = 500'000;  ///< a level with more is left out
  TimingEffort effort;
};

struct FrontierPoint {
  std::string method;  ///< "original" at level 0
  int level = 0;
  std::string form;  ///< "scan", "fast level" (as published), "tree", "grid" (fast and exact)
  double clustering = 0;
  std::size_t triangles = 0, spheres = 0;
  GeometricError error;               ///< from the smooth surface
  std::optional<double> ns = {};      ///< per query; nothing where it was not timed
  std::optional<double> ns_p99 = {};  ///< what 99 of 100 queries are done in (interleaved_timing.h)
  double tests_per_query = 0;         ///< spheres, boxes and triangles: the same on every machine
  bool best = false;                  ///< none of those compared is both faster and at most as far off
};

struct FrontierResult {
  std::vector<FrontierPoint> points;
  std::size_t reference_triangles = 0;
  int reference_levels = 0;           ///< 0: a reference was given
  std::vector<std::string> left_out;  ///< "loop level 3: ... triangles"
  bool finished = false;
};

struct SmoothSurface {
  TriangleMesh mesh;
  int levels = 0;
};
/// Returns LS3 with every edge split in place of its limit surface: so many levels, or as many as memory and
/// time allow.
SmoothSurface smooth_surface(const TriangleMesh& original, int levels);

/// The reference, unless one is given: the smooth surface of up to `levels` + 2 levels. One surface for all
/// methods, since a method's own limit would excuse what it does to the shape (mid-point's is the coarse
/// mesh).
FrontierResult run_frontier(const TriangleMesh& original, const FrontierSettings& settings,
                            const PrintProgress& print_progress);

/// Marks the points that no other of those for which `among` holds beats.
void mark_best(std::vector<FrontierPoint>& points, const std::function<bool(const FrontierPoint&)>& among);

/// `diagonal`: of the original mesh, for errors in percent of it.
support::Table frontier_table(const FrontierResult& result, double diagonal);

}  // namespace touchmark::bench::experiments::papers
