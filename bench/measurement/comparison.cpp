#include "bench/measurement/comparison.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bench/ground_truth/ground_truth.h"
#include "bench/measurement/measurement.h"
#include "bench/support/interleaving.h"
#include "bench/support/random.h"
#include "bench/support/system/available_memory.h"
#include "bench/support/system/interrupt.h"
#include "bench/workers/shared_workload.h"
#include "bench/workers/timing/eviction.h"

namespace touchmark::bench::measurement {
namespace {

using Action = void (Measurement::*)();

struct Request {
  std::size_t which = 0;
  Action action = nullptr;
};

/// Passes for latency and with emptied caches are spread over the rounds.
std::vector<Request> requests_for(std::size_t measurements, const Effort& effort, support::Random random) {
  std::vector<std::vector<Action>> rounds{{&Measurement::first_pass}};
  std::size_t clocked = 0, emptied = 0;
  for (std::size_t round = 1; round <= effort.repetitions; ++round) {
    std::vector<Action>& actions = rounds.emplace_back(1, &Measurement::repetition);
    for (; clocked * effort.repetitions < round * effort.latency_passes; ++clocked)
      actions.push_back(&Measurement::latency_pass);
    for (; emptied * effort.repetitions < round * effort.cold_passes; ++emptied)
      actions.push_back(&Measurement::cold_pass);
  }
  std::vector<std::size_t> turns;
  for (const std::vector<Action>& actions : rounds) turns.push_back(actions.size() * measurements);
  std::vector<Request> requests;
  for (const auto& [round, which] : support::interleaved(turns, random))
    requests.push_back({which % measurements, rounds[round][which / measurements]});
  return requests;
}

/// Null where it stores what it is given, or where nothing is left of the mesh that could be judged by.
std::unique_ptr<const ground_truth::RoundedMesh> rounded_mesh(const contestants::ContestantInfo& info,
                                                              const contestants::ContestantSpec& spec,
                                                              const TriangleMesh& mesh) {
  if (!info.built()) return nullptr;
  std::optional<contestants::StorageRounding> storage_rounding = info.storage_rounding(mesh, spec.values);
  if (!storage_rounding) return nullptr;
  try {
    return std::make_unique<const ground_truth::RoundedMesh>(mesh, *std::move(storage_rounding));
  } catch (const MeshError&) {
    return nullptr;
  }
}

/// Before the oracle takes it for its boxes and triangles, and the workers for their copy.
const workload::Workload& with_room(const workload::Workload& workload) {
  constexpr double bytes_a_triangle = 270;
  support::require_memory(fmt::format("the oracle's {} triangles", workload.mesh.size()),
                          bytes_a_triangle * static_cast<double>(workload.mesh.size()));
  return workload;
}

/// Returns how many steps' room the samples of one pass with emptied caches take, and the memory that is
/// walked over to empty them: all workers walk over the output that they share.
std::size_t steps_for_cold(const Effort& effort) {
  if (effort.cold_passes == 0) return 0;
  const std::size_t samples = effort.of_cold_pass(std::max(effort.cold_samples, effort.cold_l2_samples));
  return std::max(cold_floor_samples + samples, workers::steps_to_evict_all());
}

}  // namespace

Comparison::Comparison(const contestants::Roster& roster, const workload::Workload& workload,
                       const std::vector<contestants::ContestantSpec>& contestants,
                       const workers::WorkerOptions& workers, const Effort& effort, std::uint64_t seed)
    : roster_(roster),
      workload_(with_room(workload)),
      effort_(effort),
      seed_(seed),
      arena_(workload, workers, steps_for_cold(effort)),
      workload_truths_(workload) {
  for (const contestants::ContestantSpec& spec : contestants)
    processes_.emplace_back(arena_, spec, roster.find(spec.name).worker_program(spec.values));
  rounded_meshes_.resize(processes_.size());
  truths_.resize(workload.traces.size());
}

void Comparison::skip(const contestants::ContestantSpec& spec, const std::string& status) {
  for (workers::ContestantProcess& process : processes_)
    if (process.spec().text() == spec.text()) process.mark_failed(status);
}

std::unique_ptr<ground_truth::TraceTruths> Comparison::truths_of(std::size_t trace) {
  return workload_truths_.of(trace);
}

std::vector<ResultRow> Comparison::run(std::size_t trace, workload::Query query) {
  return run(trace, query, *truths_of(trace));
}

void Comparison::run_all(const std::vector<workload::Query>& queries, std::vector<ResultRow>& rows) {
  for (std::size_t trace = 0; trace < workload_.traces.size(); ++trace) {
    const std::unique_ptr<ground_truth::TraceTruths> truths = truths_of(trace);
    for (const workload::Query query : queries) {
      const std::vector<ResultRow> some = run(trace, query, *truths);
      rows.insert(rows.end(), some.begin(), some.end());
    }
  }
}

/// One trajectory on its way from the first answer to the rows.
struct Comparison::Begun {
  std::size_t trace = 0;
  workload::Query query = workload::Query::nearest;
  workload::SamplePlan plan;
  std::deque<Measurement> measurements = {};
  std::vector<std::size_t> whose = {};         ///< the process of each measurement
  std::vector<Measurement*> interleaved = {};  ///< the measurements that take turns
  Measurement* controlled = nullptr;
  std::optional<Measurement> control = std::nullopt;
  std::vector<Request> requests = {};
  std::size_t done = 0;  ///< how many of the requests
};

Comparison::~Comparison() = default;

std::vector<ResultRow> Comparison::run(std::size_t trace, workload::Query query,
                                       ground_truth::TraceTruths& truths) {
  begin(trace, query, truths);
  return end();
}

void Comparison::begin(std::size_t trace, workload::Query query) { begin(trace, query, *truths_of(trace)); }

void Comparison::begin(std::size_t trace, workload::Query query, ground_truth::TraceTruths& truths) {
  Begun& begun = *begun_.emplace_back(std::make_unique<Begun>(Begun{trace, query, plan_for(trace, truths)}));
  const std::string& trajectory = workload_.trajectories[trace];
  for (std::size_t i = 0; i < processes_.size(); ++i) {
    const std::string contestant = processes_[i].spec().text();
    if (!filter_(trajectory, contestant)) {
      left_out_.emplace_back(trajectory, contestant);
      continue;
    }
    begun.measurements.emplace_back(workload_, arena_, effort_, processes_[i], trace, query, begun.plan);
    begun.whose.push_back(i);
  }
  verify(begun, truths);
  if (effort_.max_logged_steps > 0) truths_[trace] = truths.known(query);
  add_control(begun, truths);
  begun.requests = requests_for(begun.interleaved.size(), effort_, support::Random(seed_ + trace));
  measure(begun, begun.requests.size() / 2);
}

void Comparison::verify(Begun& begun, ground_truth::TraceTruths& truths) {
  for (std::size_t i = 0; i < begun.measurements.size(); ++i) {
    Measurement& one = begun.measurements[i];
    support::check_for_interrupt();
    progress_(workload_.trajectories[begun.trace], one.contestant());
    one.calibrate();
    verify(one, rounded_mesh_of(begun.whose[i]), begun.trace, truths);
    begun.interleaved.push_back(&one);
    if (schedule_ == Schedule::interleaved) continue;
    begun.requests = requests_for(begun.interleaved.size(), effort_, support::Random(seed_ + begun.trace));
    measure(begun, begun.requests.size());
    begun.done = 0;
    begun.interleaved.clear();
    one.shut_down();
  }
}

void Comparison::add_control(Begun& begun, ground_truth::TraceTruths& truths) {
  begun.controlled = to_control(begun.interleaved);
  if (begun.controlled == nullptr) return;
  begun.control.emplace(workload_, arena_, effort_, *control_, begun.trace, begun.query, begun.plan);
  begun.control->calibrate_like(*begun.controlled);
  begun.control->verify(truths);
  begun.interleaved.push_back(&*begun.control);
}

std::vector<ResultRow> Comparison::end() {
  Begun& begun = *begun_.front();
  measure(begun, begun.requests.size());
  std::vector<ResultRow> rows = rows_of(begun);
  begun_.pop_front();
  return rows;
}

std::vector<ResultRow> Comparison::so_far() {
  std::vector<ResultRow> rows;
  for (const std::unique_ptr<Begun>& begun : begun_) {
    for (Measurement& one : begun->measurements) {
      ResultRow row = one.row();
      const bool timed = row.throughput && (row.latency || effort_.latency_passes == 0);
      if (timed || row.status != "ok") rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<ResultRow> Comparison::rows_of(Begun& begun) {
  std::vector<ResultRow> rows;
  std::optional<Control> found;
  for (Measurement& one : begun.measurements) {
    if (effort_.line_samples > 0) {
      support::check_for_interrupt();
      progress_(fmt::format("{}, cache lines", workload_.trajectories[begun.trace]), one.contestant());
    }
    one.count_lines();
    rows.push_back(one.row());
    if (&one == begun.controlled) found = control_of(rows.back(), begun.control->row());
  }
  if (effort_.repetitions > 0 && !rows.empty()) steadiness_.push_back(steadiness_of(rows, std::move(found)));
  return rows;
}

workload::SamplePlan Comparison::plan_for(std::size_t trace, ground_truth::TraceTruths& truths) const {
  const std::vector<workload::Step>& steps = workload_.traces[trace];
  const std::vector<double> distances = truths.distances(workload::telling_steps(steps.size()));
  return {steps.size(), workload::phases_of(steps, distances, workload_.mesh.diagonal()), seed_ + trace};
}

Measurement* Comparison::to_control(const std::vector<Measurement*>& measurements) {
  if (effort_.repetitions == 0) return nullptr;
  Measurement* chosen = nullptr;
  for (Measurement* const one : measurements) {
    if (!one->alive() || !one->claims_exactness()) continue;
    if (control_ && one->spec().text() == control_->spec().text()) return one;
    if (chosen == nullptr || one->calibrated_ns() < chosen->calibrated_ns()) chosen = one;
  }
  if (chosen == nullptr) return nullptr;
  const contestants::ContestantSpec& spec = chosen->spec();
  control_.emplace(arena_, spec, roster_.find(spec.name).worker_program(spec.values));
  return chosen;
}

const ground_truth::RoundedMesh* Comparison::rounded_mesh_of(std::size_t process) {
  std::optional<std::unique_ptr<const ground_truth::RoundedMesh>>& rounded = rounded_meshes_[process];
  if (workload_.scene) return nullptr;
  if (!rounded) {
    const contestants::ContestantSpec& spec = processes_[process].spec();
    rounded = rounded_mesh(roster_.find(spec.name), spec, workload_.mesh);
  }
  return rounded->get();
}

void Comparison::verify(Measurement& one, const ground_truth::RoundedMesh* rounded, std::size_t trace,
                        ground_truth::TraceTruths& truths) {
  if (rounded == nullptr) return one.verify(truths);
  ground_truth::GroundTruths of_rounded(rounded->oracle(), rounded->trace(workload_.traces[trace]));
  one.verify(truths, &of_rounded);
}

void Comparison::measure(Begun& begun, std::size_t end) {
  if (effort_.repetitions == 0) return;
  for (; begun.done < end; ++begun.done) {
    const Request& request = begun.requests[begun.done];
    support::check_for_interrupt();
    Measurement& one = *begun.interleaved[request.which];
    if (request.action == &Measurement::cold_pass && begun.control && &one == &*begun.control) continue;
    progress_(fmt::format("{}, {} %", workload_.trajectories[begun.trace],
                          100 * begun.done / begun.requests.size()),
              one.contestant());
    (one.*request.action)();
  }
}

}  // namespace touchmark::bench::measurement
