/// The experiment of Park & Jang (Journal of Digital Contents Society 19(1), 2018, pp. 199-204, in Korean):
/// the time of a query against the number of groups, for cubes and for spheres (their Fig. 7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/experiments/papers/choi_sung/choi_sung.h"
#include "bench/experiments/papers/claims.h"
#include "bench/experiments/papers/interleaved_timing.h"
#include "bench/experiments/papers/paper_meshes.h"
#include "bench/support/length.h"

namespace touchmark::bench::experiments::papers {

/// In the paper: the groups of Figs 5 and 6; in Fig. 7 from where on a query takes a tenth of the ungrouped
/// time, the best count of cuboids, and from where on the time rises again.
inline constexpr std::size_t park_jang_cubes = 379, park_jang_spheres = 2115, park_jang_tenth = 61,
                             park_jang_best_count = 214, park_jang_turn = 783;

struct ParkJangSettings {
  std::vector<std::size_t> groups;  ///< the numbers that are aimed at
  std::size_t steps = 8000;         ///< all places together, for the counts
  std::size_t places = 40;          ///< short slides, each of a seed of its own
  std::size_t timed_steps = 200;    ///< all places together, at most, for the times
  std::uint64_t seed = 1;
  support::Length radius;  ///< the probe's
  TimingEffort effort;
};
/// One group to `most`, the paper's counts among them.
std::vector<std::size_t> park_jang_group_counts(std::size_t most);

/// What the queries of all places looked at: groups and triangles, the same on every machine.
struct CountedTests {
  double mean = 0;               ///< per query
  std::vector<double> by_place;  ///< means of each place's queries
  std::size_t contacts = 0;      ///< queries that found one
  std::uint64_t answers = 0;     ///< a checksum
};
/// The value below which this part of the places lies.
double place_quantile(const CountedTests& counted, double part);

struct ParkJangRow {
  std::string mesh;
  std::size_t triangles = 0;
  /// "cube", "sphere" (the smallest), "centered-sphere" (about the cuboid's centre), as published;
  /// "ungrouped"; "direct": the fast exact form.
  std::string form;
  double cell = 0;         ///< edge, mesh units; 0 without
  std::size_t groups = 0;  ///< 0 without
  std::optional<TimedTurns> timed;
  CountedTests counted = {};
  double groups_per_triangle = 0;  ///< mean number of groups that a triangle lies in; 0 without
};

/// What a test takes in arithmetic operations and comparisons, as the textbook that the paper cites has it
/// (Ericson, "Real-Time Collision Detection", 2005): a point against a cuboid, a sphere, a triangle's closest
/// point. A triangle is many times a group, so where a curve turns depends on their ratio, not on the number
/// of tests alone. Which region of the triangle the point is over decides what its test takes: 29 beside a
/// corner to 86 over the face; 46 to 49 on average over all triangles of the bunnies, 50 to 66 over those
/// within a twentieth of the box diagonal. The tests count each of the three.
inline constexpr double cuboid_operations = 6, sphere_operations = 9, triangle_operations = 50;

/// Returns the operations of a query that looked at so many groups and triangles together; 0 for the direct
/// form.
double operations_of(const ParkJangRow& row, double tests);

struct ParkJangResult {
  std::vector<ParkJangRow> rows;
  std::optional<std::size_t> pictured_cubes, pictured_spheres;  ///< the groups of Figs 5 and 6, where drawn
  bool answers_agree = true;
  bool finished = false;  ///< false: interrupted
};

/// The best of a mesh and a shape.
struct ParkJangBest {
  std::string mesh;
  std::size_t triangles = 0;
  std::string shape;
  std::size_t groups = 0;           ///< the count with the least time
  std::size_t from = 0, to = 0;     ///< groups whose time is within 10 % of it
  double ns = 0, ungrouped_ns = 0;  ///< per query
  double last_ns = 0;               ///< at the most groups
  double factor() const noexcept { return ns > 0 ? ungrouped_ns / ns : 0; }
};

/// The curve of Fig. 7 for a mesh and a shape, in operations per query. A count between two that were tried
/// is interpolated, logarithms by logarithms.
struct ParkJangCurve {
  std::string mesh;
  std::size_t triangles = 0;
  std::string shape;
  std::size_t best = 0;  ///< the count with the fewest operations
  std::size_t best_of_places_from = 0,
              best_of_places_to = 0;  ///< best counts of single places: their middle half
  double factor = 0;                  ///< ungrouped operations over the fewest
  std::optional<double> tenth_from;   ///< from how many groups on a query takes a tenth of the ungrouped
  std::optional<double> rises_from;   ///< beyond how many it takes a tenth more than with the best count
};

ParkJangResult run_park_jang(const std::vector<PaperMesh>& meshes, const ParkJangSettings& settings,
                             const PrintProgress& print_progress);

/// Returns the best of every mesh and shape that was timed.
std::vector<ParkJangBest> park_jang_best(const ParkJangResult& result);
/// Returns the curve of every mesh and shape that was counted with two or more counts.
std::vector<ParkJangCurve> park_jang_curves(const ParkJangResult& result);
std::vector<Claim> park_jang_claims(const ParkJangResult& result);

/// times.csv and best.csv.
support::Table park_jang_times(const ParkJangResult& result);
support::Table park_jang_best_table(const ParkJangResult& result);
std::string park_jang_report(const std::vector<PaperMesh>& meshes, const ParkJangSettings& settings,
                             const ParkJangResult& result);

}  // namespace touchmark::bench::experiments::papers
