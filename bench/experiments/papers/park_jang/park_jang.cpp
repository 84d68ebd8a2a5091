#include "bench/experiments/papers/park_jang/park_jang.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "bench/contestants/entry.h"
#include "bench/experiments/papers/paper_trace.h"
#include "bench/support/failures.h"
#include "bench/support/names.h"
#include "bench/support/system/available_memory.h"
#include "bench/support/system/interrupt.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/grid_group/published/published_grid_group.h"

namespace touchmark::bench::experiments::papers {
namespace {

using Steps = std::vector<workload::Step>;

/// Short slides in many places, one after the other; of each the first `steps`.
struct Places {
  std::vector<std::vector<workload::Step>> paths;

  Steps first_of_each(std::size_t steps) const {
    Steps chosen;
    for (const Steps& path : paths)
      chosen.insert(chosen.end(), path.begin(),
                    path.begin() + static_cast<std::ptrdiff_t>(std::min(steps, path.size())));
    return chosen;
  }
};

Places places_on(const TriangleMesh& mesh, const ParkJangSettings& settings) {
  const std::size_t count = std::clamp<std::size_t>(settings.places, 1, settings.steps);
  Places places;
  for (std::size_t place = 0; place < count; ++place)
    places.paths.push_back(paper_trace("slide", mesh, std::max<std::size_t>(settings.steps / count, 1),
                                       settings.seed + place, settings.radius.in_mesh_units(mesh)));
  return places;
}

/// Asks the detector at every step of every place, untimed.
CountedTests count_tests(contestants::Contestant& detector, const Places& places) {
  CountedTests counted;
  workload::Checksum checksum;
  std::size_t steps = 0;
  for (const Steps& path : places.paths) {
    support::check_for_interrupt();
    std::vector<workload::Answer> answers(path.size());
    std::vector<std::uint64_t> work(path.size());
    detector.answer({workload::Query::nearest, path}, {0, path.size()}, answers, work);
    for (const workload::Answer& answer : answers) {
      checksum.add(answer);
      counted.contacts += answer.found;
    }
    const auto tests = static_cast<double>(std::accumulate(work.begin(), work.end(), std::uint64_t{0}));
    counted.by_place.push_back(tests / static_cast<double>(path.size()));
    counted.mean += tests;
    steps += path.size();
  }
  counted.mean /= static_cast<double>(steps);
  counted.answers = checksum.value();
  detector.forget();
  return counted;
}

using Shape = PublishedGridGroup::Shape;

constexpr std::array<support::Name<Shape>, 3> shape_names{
    {{Shape::cube, "cube"}, {Shape::sphere, "sphere"}, {Shape::centered_sphere, "centered-sphere"}}};

std::string name_of(Shape shape) { return std::string(support::name_in(shape_names, shape)); }

/// One mesh: the ungrouped form, the published ones at every count, the fast one.
class MeshExperiment {
 public:
  MeshExperiment(const PaperMesh& mesh, const ParkJangSettings& settings, const PrintProgress& print_progress)
      : mesh_(mesh),
        settings_(settings),
        print_progress_(print_progress),
        places_(places_on(mesh.mesh, settings)),
        trace_(places_.first_of_each(
            std::max<std::size_t>(settings.timed_steps / std::max<std::size_t>(places_.paths.size(), 1), 1))),
        timing_(trace_, workload::Query::nearest, settings.seed) {}

  /// Throws Interrupted; the rows so far can be taken nevertheless.
  void run() {
    support::require_memory_for_triangles(mesh_.mesh.size(), support::min_bytes_per_triangle);
    add("ungrouped", 0, 0, contestants::contestant<BruteForce>(mesh_.mesh, {}));
    for (const Shape shape : {Shape::cube, Shape::sphere, Shape::centered_sphere}) add_counts(shape);
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
    return std::ranges::all_of(rows_, [this](const ParkJangRow& row) {
      return row.counted.answers == rows_.front().counted.answers;
    });
  }

 private:
  void add_counts(Shape shape) {
    std::size_t last = 0;
    for (const std::size_t groups : settings_.groups) {
      print_progress_(fmt::format("{}: {} groups", mesh_.name, groups));
      auto detector = PublishedGridGroup::build(mesh_.mesh, {.shape = shape, .groups = groups});
      // Small meshes do not come in every number of groups.
      if (detector.groups() <= last) continue;
      last = detector.groups();
      const double cell = detector.cell();
      add(name_of(shape), cell, last,
          std::make_unique<contestants::ContestantOf<PublishedGridGroup>>(std::move(detector)));
      rows_.back().groups_per_triangle = groups_per_triangle(cell);
    }
  }

  void add(const std::string& form, double cell, std::size_t groups,
           std::unique_ptr<contestants::Contestant> detector) {
    const CountedTests counted = count_tests(*detector, places_);
    timing_.add(std::move(detector));
    rows_.push_back({mesh_.name, mesh_.mesh.size(), form, cell, groups, std::nullopt, counted});
  }

  double groups_per_triangle(double cell) const {
    if (!(cell > 0)) return 0;
    const auto grid = PublishedGridGroup::build(mesh_.mesh, {.cell = cell});
    std::size_t memberships = 0;
    for (std::size_t group = 0; group < grid.groups(); ++group) memberships += grid.members(group).size();
    return static_cast<double>(memberships) / static_cast<double>(mesh_.mesh.size());
  }

  const PaperMesh& mesh_;
  const ParkJangSettings& settings_;
  const PrintProgress& print_progress_;
  Places places_;
  Steps trace_;
  InterleavedTiming timing_;
  std::vector<ParkJangRow> rows_;  // row i is the timing's detector i
};

}  // namespace

double place_quantile(const CountedTests& counted, double part) {
  if (counted.by_place.empty()) return counted.mean;
  std::vector<double> sorted = counted.by_place;
  std::ranges::sort(sorted);
  return sorted[static_cast<std::size_t>(std::lround(part * static_cast<double>(sorted.size() - 1)))];
}

std::vector<std::size_t> park_jang_group_counts(std::size_t most) {
  std::vector<std::size_t> counts;
  for (const std::size_t count :
       {1,   2,   4,   8,   16,  24,  32,   45,   61,   80,   100,  130,  160,   214,   300,
        379, 460, 550, 650, 783, 950, 1100, 1550, 2115, 3000, 4500, 7000, 12000, 20000, 35000})
    if (count <= most) counts.push_back(count);
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
