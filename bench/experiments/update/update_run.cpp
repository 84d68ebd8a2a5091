#include "bench/experiments/update/update_run.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "bench/support/random.h"
#include "bench/support/system/interrupt.h"
#include "bench/trajectories/trajectories.h"
#include "bench/workload/sample_steps.h"

namespace touchmark::bench::experiments::update {
namespace {

constexpr std::size_t default_steps = 5000;
constexpr std::size_t probes_near_what_moved = 1000;
constexpr double ns_to_time = 50e6;

/// About places where moved vertices were and are, within four radii.
std::vector<workload::Step> near_what_moved(const TriangleMesh& before, const TriangleMesh& after,
                                            const workload::Step& like, std::uint64_t seed) {
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < before.vertices().size(); ++i)
    if (std::memcmp(before.vertices()[i].data(), after.vertices()[i].data(), 3 * sizeof(double)) != 0)
      moved.push_back(i);
  support::Random random(seed);
  std::vector<workload::Step> steps;
  for (std::size_t i = 0; i < probes_near_what_moved && !moved.empty(); ++i) {
    const std::size_t vertex = moved[random.below(moved.size())];
    const Vec3& near = (i % 2 == 0 ? before : after).vertices()[vertex];
    steps.push_back(like);
    const Vec3 away = random.direction();
    steps.back().probe.center = near + 4 * like.probe.radius * random.unit() * away;
  }
  if (steps.empty()) steps.push_back(like);
  return steps;
}

}  // namespace

UpdateRun::DeformedMesh::DeformedMesh(const TriangleMesh& undeformed, const meshes::Deformation& how)
    : deformation(how),
      mesh(meshes::deformed(undeformed, how)),
      moved(meshes::moved_vertices(undeformed, mesh)),
      oracle(mesh) {}

UpdateRun::UpdateRun(const contestants::Roster& roster,
                     const std::vector<contestants::ContestantSpec>& contestants,
                     const workload::Selection& selection, std::string mesh_name, const TriangleMesh& mesh,
                     const std::vector<double>& shares, const std::string& trajectory,
                     const workers::WorkerOptions& workers)
    : query_(selection.queries.front()),
      workload_{[&] {
        workload::Workload all{std::move(mesh_name), mesh, selection.radius.in_mesh_units(mesh), {}, {}, {}};
        if (selection.reach) all.reach = selection.reach->in_mesh_units(mesh);
        for (const double share : shares) {
          meshes_.push_back(std::make_unique<DeformedMesh>(mesh, meshes::Deformation{share, selection.seed}));
          workload::Workload one = workload::make_workload(all.mesh_name, meshes_.back()->mesh, selection,
                                                           {trajectory}, default_steps);
          const std::string after = fmt::format("after {:g} % moved", 100 * share);
          all.trajectories.push_back(one.trajectories[0] + ' ' + after);
          all.trajectories.push_back("about what moved " + after);
          all.motions.push_back(one.motions[0]);
          all.motions.emplace_back();
          all.unit = one.unit;
          all.traces.push_back(std::move(one.traces[0]));
          all.traces.push_back(
              near_what_moved(mesh, meshes_.back()->mesh, all.traces.back()[0], selection.seed));
        }
        return all;
      }()},
      arena_(workload_, workers) {
  for (const contestants::ContestantSpec& spec : contestants)
    processes_.emplace_back(arena_, spec, roster.find(spec.name).worker_program(spec.values));
  for (std::size_t trace = 0; trace < workload_.traces.size(); ++trace) {
    DeformedMesh& changed = *meshes_[trace / traces_a_mesh];
    changed.truths.emplace_back(changed.oracle, workload_.traces[trace]);
  }
}

workers::Task UpdateRun::task_for(std::size_t trace) const {
  return {trace, query_, workload_.traces[trace].size()};
}

workers::Timed UpdateRun::timed(workers::ContestantProcess& process, const workers::Task& task) const {
  const double pass_ns = std::max(process.ask(workers::request::FirstPass{task}).ns_per_query, 1.0) *
                         static_cast<double>(task.steps);
  return process.ask(
      workers::request::Time{task, static_cast<std::int64_t>(std::max(ns_to_time / pass_ns, 1.0))});
}

void UpdateRun::measure(workers::ContestantProcess& process, std::size_t index, UpdateRow& row) {
  DeformedMesh& changed = *meshes_[index];
  const workers::Built& built = process.build();
  row.accuracy = built.accuracy;
  const bool answers = std::ranges::find(built.queries, query_) != built.queries.end();
  const workers::Updated updated =
      answers ? process.ask(workers::request::Update{changed.deformation}) : workers::Updated{};
  if (!updated.supported) {
    row.status = "unsupported";
    return;
  }
  if (!updated.refused.empty()) throw workers::WorkerFailure("refused: " + updated.refused);
  row.updated = updated;
  oracle::ErrorCounts counts;
  for (std::size_t k = 0; k < traces_a_mesh; ++k) {
    const workers::Task task = task_for(traces_a_mesh * index + k);
    process.ask(workers::request::Answer{task});
    counts += changed.truths[k].judge(query_, workload::sample_steps(task.steps, task.steps),
                                      arena_.buffers().answers(task.steps), *row.accuracy);
  }
  row.counts = counts;
  const workers::Task along = task_for(traces_a_mesh * index);
  const workers::Timed after_update = timed(process, along);
  process.ask(workers::request::Rebuild{changed.deformation});
  const workers::Timed after_build = timed(process, along);
  row.ns_updated = after_update.cpu_ns_per_query;
  row.ns_built = after_build.cpu_ns_per_query;
  row.answers_as_built = after_update.checksum == after_build.checksum;
}

std::vector<UpdateRow> UpdateRun::run(std::size_t contestant,
                                      const std::function<void(double share)>& progress) {
  workers::ContestantProcess& process = processes_[contestant];
  const contestants::ContestantSpec& spec = process.spec();
  std::vector<UpdateRow> rows;
  for (std::size_t i = 0; i < meshes_.size(); ++i) {
    support::check_for_interrupt();
    progress(meshes_[i]->deformation.share);
    UpdateRow& row = rows.emplace_back();
    row.detector = spec.name;
    row.options = spec.options;
    row.mesh = workload_.mesh_name;
    row.triangles = workload_.mesh.size();
    row.vertices = workload_.mesh.vertices().size();
    row.share = meshes_[i]->deformation.share;
    row.moved_vertices = meshes_[i]->moved;
    try {
      measure(process, i, row);
    } catch (const workers::WorkerFailure& failure) {
      row.status = failure.what();
    }
  }
  process.end();
  return rows;
}

}  // namespace touchmark::bench::experiments::update
