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

#include "bench/experiments/papers/choi_sung.h"
#include "bench/experiments/papers/claims.h"
#include "bench/experiments/papers/interleaved_timing.h"
#include "bench/experiments/papers/paper_meshes.h"
#include "bench/support/length.h"

namespace touchmark::bench::experiments::papers {

/// In the paper: the groups of Figs 5 and 6, and from where on the time rises again in Fig. 7.
inline constexpr std::size_t park_jang_cubes = 379, park_jang_spheres = 2115, park_jang_turn = 783;

struct ParkJangSettings {
  std::vector<std::size_t> groups;  ///< the numbers that are aimed at
  std::size_t steps = 200;
  std::uint64_t seed = 1;
  support::Length radius;  ///< the probe's
  TimingEffort effort;
};
/// One group to `most`, the paper's counts among them.
std::vector<std::size_t> park_jang_group_counts(std::size_t most);

struct ParkJangRow {
  std::string mesh;
  std::size_t triangles = 0;
  std::string form;        ///< "cube" or "sphere", as published; "ungrouped"; "direct": the fast exact form
  double cell = 0;         ///< edge, mesh units; 0 without
  std::size_t groups = 0;  ///< 0 without
  std::optional<TimedTurns> timed;
};

struct ParkJangResult {
  std::vector<ParkJangRow> rows;
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

ParkJangResult run_park_jang(const std::vector<PaperMesh>& meshes, const ParkJangSettings& settings,
                             const PrintProgress& print_progress);

/// Returns the best of every mesh and shape that was timed.
std::vector<ParkJangBest> park_jang_best(const ParkJangResult& result);
std::vector<Claim> park_jang_claims(const ParkJangResult& result);

/// times.csv and best.csv.
support::Table park_jang_times(const ParkJangResult& result);
support::Table park_jang_best_table(const ParkJangResult& result);
std::string park_jang_report(const std::vector<PaperMesh>& meshes, const ParkJangSettings& settings,
                             const ParkJangResult& result);

}  // namespace touchmark::bench::experiments::papers
