#include "bench/experiments/papers/park_jang.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "bench/contestants/entry.h"
#include "bench/experiments/papers/paper_trace.h"
#include "bench/support/available_memory.h"
#include "bench/support/failures.h"
#include "bench/support/interrupt.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"

namespace touchmark::bench::experiments::papers {
namespace {

/// One mesh: the ungrouped form, the published ones at every count, the fast one.
class MeshExperiment {
 public:
  MeshExperiment(const PaperMesh& mesh, const ParkJangSettings& settings, const PrintProgress& print_progress)
      : mesh_(mesh),
        settings_(settings),
        print_progress_(print_progress),
        trace_(paper_trace("slide", mesh.mesh, settings.steps, settings.seed,
                           settings.radius.in_mesh_units(mesh.mesh))),
        timing_(trace_, workload::Query::nearest, settings.seed) {}

  /// Throws Interrupted; the rows so far can be taken nevertheless.
  void run() {
    support::require_memory_for_triangles(mesh_.mesh.size(), support::min_bytes_per_triangle);
    add("ungrouped", 0, 0, contestants::contestant<BruteForce>(mesh_.mesh, {}));
    for (const auto shape : {GridGroup::Shape::cube, GridGroup::Shape::sphere}) add_counts(shape);
    GridGroup direct = GridGroup::build(mesh_.mesh);
    const double cell = direct.cell();
    add("direct", cell, 0, std::make_unique<contestants::ContestantOf<GridGroup>>(std::move(direct)));
    timing_.run(settings_.effort, [this](std::size_t round, std::size_t detector) {
      print_progress_(fmt::format("{}, round {} of {}: {} {}", mesh_.name, round + 1, settings_.effort.rounds,
                                  rows_[detector].form, rows_[detector].groups));
    });
  }

  std::vector<ParkJangRow> rows() const {
    std::vector<ParkJangRow> rows = rows_;
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].timed = timing_.timed(i);
    return rows;
  }
  bool answers_agree() const {
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      if (timing_.timed(i).answers != timing_.timed(0).answers) return false;
    }
    return true;
  }

 private:
  void add_counts(GridGroup::Shape shape) {
    std::size_t last = 0;
    for (const std::size_t groups : settings_.groups) {
      print_progress_(fmt::format("{}: {} groups", mesh_.name, groups));
      GridGroup detector =
          GridGroup::build(mesh_.mesh, {.shape = shape, .lookup = GridGroup::Lookup::scan, .groups = groups});
      // Small meshes do not come in every number of groups.
      if (detector.groups() <= last) continue;
      last = detector.groups();
      const double cell = detector.cell();
      add(shape == GridGroup::Shape::cube ? "cube" : "sphere", cell, last,
          std::make_unique<contestants::ContestantOf<GridGroup>>(std::move(detector)));
    }
  }

  void add(const char* form, double cell, std::size_t groups,
           std::unique_ptr<contestants::Contestant> detector) {
    timing_.add(std::move(detector));
    rows_.push_back({mesh_.name, mesh_.mesh.size(), form, cell, groups, std::nullopt});
  }

  const PaperMesh& mesh_;
  const ParkJangSettings& settings_;
  const PrintProgress& print_progress_;
  std::vector<workload::Step> trace_;
  InterleavedTiming timing_;
  std::vector<ParkJangRow> rows_;  // row i is the timing's detector i
};

}  // namespace

std::vector<std::size_t> park_jang_group_counts(std::size_t most) {
  std::vector<std::size_t> counts;
  for (const std::size_t count : {1,   2,   4,    8,    16,   32,   61,   100,  160,   250,   379,
                                  550, 783, 1100, 1550, 2115, 3000, 4500, 7000, 12000, 20000, 35000}) {
    if (count <= most) counts.push_back(count);
  }
  return counts;
}

ParkJangResult run_park_jang(const std::vector<PaperMesh>& meshes, const ParkJangSettings& settings,
                             const PrintProgress& print_progress) {
  ParkJangResult result;
  for (const PaperMesh& mesh : meshes) {
    MeshExperiment experiment(mesh, settings, print_progress);
    bool interrupted = false;
    try {
      experiment.run();
    } catch (const support::Interrupted&) {
      interrupted = true;
    }
    const std::vector<ParkJangRow> rows = experiment.rows();
    result.rows.insert(result.rows.end(), rows.begin(), rows.end());
    result.answers_agree = result.answers_agree && experiment.answers_agree();
    if (interrupted) return result;
  }
  result.finished = true;
  return result;
}

std::vector<ParkJangBest> park_jang_best(const ParkJangResult& result) {
  std::vector<ParkJangBest> all;
  double ungrouped = 0;
  for (const ParkJangRow& row : result.rows) {
    if (!row.timed || row.timed->ns <= 0) continue;
    if (row.form == "ungrouped") ungrouped = row.timed->ns;
    if (row.groups == 0) continue;
    if (all.empty() || all.back().mesh != row.mesh || all.back().shape != row.form)
      all.push_back({row.mesh, row.triangles, row.form, 0, 0, 0, 0, ungrouped, 0});
    ParkJangBest& best = all.back();
    best.last_ns = row.timed->ns;
    if (best.ns == 0 || row.timed->ns < best.ns) {
      best.ns = row.timed->ns;
      best.groups = row.groups;
    }
  }
  for (ParkJangBest& best : all) {
    for (const ParkJangRow& row : result.rows) {
      if (row.mesh != best.mesh || row.form != best.shape || !row.timed || row.timed->ns > 1.1 * best.ns)
        continue;
      if (best.from == 0) best.from = row.groups;
      best.to = row.groups;
    }
  }
  return all;
}

}  // namespace touchmark::bench::experiments::papers
