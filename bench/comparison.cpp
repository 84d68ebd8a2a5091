#include "bench/comparison.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bench/available_memory.h"
#include "bench/case.h"
#include "bench/interrupt.h"
#include "bench/random.h"
#include "bench/truths.h"

namespace touchmark::bench {
namespace {

using Measurement = void (Case::*)();

struct Order {
  std::size_t which = 0;
  Measurement measurement = nullptr;
};

std::vector<Order> orders_for(std::size_t cases, const Effort& effort) {
  std::vector<Order> orders;
  for (std::size_t which = 0; which < cases; ++which) {
    orders.push_back({which, &Case::first_pass});
    orders.insert(orders.end(), effort.repetitions, {which, &Case::repetition});
    orders.insert(orders.end(), effort.latency_passes, {which, &Case::latency_pass});
  }
  return orders;
}

/// Null where it stores what it is given, or where nothing is left of the mesh that could be judged by.
std::unique_ptr<const StoredScene> stored_scene(const ContestantInfo& info, const ContestantSpec& spec,
                                                const TriangleMesh& mesh) {
  if (!info.built()) return nullptr;
  std::optional<Storing> storing = info.storing(mesh, spec.values);
  if (!storing) return nullptr;
  try {
    return std::make_unique<const StoredScene>(mesh, *std::move(storing));
  } catch (const MeshError&) {
    return nullptr;
  }
}

/// Before the oracle takes it for its boxes and triangles, and the workers for their copy.
const Workload& with_room(const Workload& workload) {
  constexpr double bytes_a_triangle = 270;
  require_memory(fmt::format("the oracle's {} triangles", workload.mesh.size()),
                 bytes_a_triangle * static_cast<double>(workload.mesh.size()));
  return workload;
}

}  // namespace

Comparison::Comparison(const Roster& roster, const Workload& workload,
                       const std::vector<ContestantSpec>& contestants, const WorkerOptions& workers,
                       const Effort& effort, std::uint64_t seed)
    : roster_(roster),
      workload_(with_room(workload)),
      effort_(effort),
      seed_(seed),
      stage_(workload, workers),
      oracle_(workload.mesh) {
  for (const ContestantSpec& spec : contestants) {
    processes_.emplace_back(stage_, spec, roster.find(spec.name).worker_program(spec.values));
  }
  stored_.resize(processes_.size());
}

void Comparison::skip(const ContestantSpec& spec, const std::string& status) {
  for (ContestantProcess& process : processes_) {
    if (process.spec().text() == spec.text()) process.give_up(status);
  }
}

std::vector<ResultRow> Comparison::run(std::size_t course, Query query) {
  Truths truths(oracle_, workload_.courses[course]);
  return run(course, query, truths);
}

void Comparison::run_all(const std::vector<Query>& queries, std::vector<ResultRow>& rows) {
  for (std::size_t course = 0; course < workload_.courses.size(); ++course) {
    Truths truths(oracle_, workload_.courses[course]);
    for (const Query query : queries) {
      const std::vector<ResultRow> some = run(course, query, truths);
      rows.insert(rows.end(), some.begin(), some.end());
    }
  }
}

std::vector<ResultRow> Comparison::run(std::size_t course, Query query, Truths& truths) {
  const std::string& trajectory = workload_.trajectories[course];
  std::deque<Case> cases;
  std::vector<std::size_t> whose;  // the process of each case
  for (std::size_t i = 0; i < processes_.size(); ++i) {
    if (!filter_(trajectory, processes_[i].spec().text())) continue;
    cases.emplace_back(workload_, stage_, effort_, processes_[i], course, query);
    whose.push_back(i);
  }
  std::vector<Case*> together;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    check_for_interrupt();
    progress_(trajectory, cases[i].contestant());
    cases[i].introduce();
    verify(cases[i], stored_by(whose[i]), course, truths);
    if (turns_ == Turns::together) {
      together.push_back(&cases[i]);
    } else {
      measure({&cases[i]}, trajectory, seed_ + course);
      cases[i].dismiss();
    }
  }
  measure(together, trajectory, seed_ + course);
  std::vector<ResultRow> rows;
  for (Case& one : cases) rows.push_back(one.finish());
  return rows;
}

const StoredScene* Comparison::stored_by(std::size_t process) {
  std::optional<std::unique_ptr<const StoredScene>>& stored = stored_[process];
  if (!stored) {
    const ContestantSpec& spec = processes_[process].spec();
    stored = stored_scene(roster_.find(spec.name), spec, workload_.mesh);
  }
  return stored->get();
}

void Comparison::verify(Case& one, const StoredScene* stored, std::size_t course, Truths& truths) {
  if (stored == nullptr) return one.verify(truths);
  Truths of_stored(stored->oracle(), stored->course(workload_.courses[course]));
  one.verify(truths, &of_stored);
}

void Comparison::measure(const std::vector<Case*>& cases, const std::string& trajectory, std::uint64_t seed) {
  if (effort_.repetitions == 0) return;
  std::vector<Order> orders = orders_for(cases.size(), effort_);
  Random(seed).shuffle(orders);
  for (const Order& order : orders) {
    check_for_interrupt();
    Case& one = *cases[order.which];
    progress_(trajectory, one.contestant());
    (one.*order.measurement)();
  }
}

}  // namespace touchmark::bench
