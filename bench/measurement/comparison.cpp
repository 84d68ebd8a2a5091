#include "bench/measurement/comparison.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bench/ground_truth/ground_truth.h"
#include "bench/measurement/measurement.h"
#include "bench/support/available_memory.h"
#include "bench/support/interrupt.h"
#include "bench/support/random.h"

namespace touchmark::bench {
namespace {

using Measurement = void (Case::*)();

struct Order {
  std::size_t which = 0;
  Measurement measurement = nullptr;
};

void append_shuffled(std::vector<Order>& orders, std::vector<Order> some, Random& random) {
  random.shuffle(some);
  orders.insert(orders.end(), some.begin(), some.end());
}

/// Round by round, so that whatever changes on the machine meets all contestants alike; in random order
/// within a round. Passes for latency are spread over the rounds.
std::vector<Order> orders_for(std::size_t cases, const Effort& effort, Random random) {
  std::vector<Order> orders;
  const auto all = [&](Measurement measurement) {
    std::vector<Order> some;
    for (std::size_t which = 0; which < cases; ++which) some.push_back({which, measurement});
    return some;
  };
  append_shuffled(orders, all(&Case::first_pass), random);
  std::size_t clocked = 0;
  for (std::size_t round = 1; round <= effort.repetitions; ++round) {
    std::vector<Order> some = all(&Case::repetition);
    for (; clocked * effort.repetitions < round * effort.latency_passes; ++clocked) {
      const std::vector<Order> more = all(&Case::latency_pass);
      some.insert(some.end(), more.begin(), more.end());
    }
    append_shuffled(orders, std::move(some), random);
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

/// One trajectory on its way from the first answer to the rows.
struct Comparison::Begun {
  std::size_t course = 0;
  Query query = Query::nearest;
  SamplePlan plan;
  std::deque<Case> cases = {};
  std::vector<std::size_t> whose = {};  ///< the process of each case
  std::vector<Case*> together = {};     ///< those that take turns
  Case* controlled = nullptr;
  std::optional<Case> control = std::nullopt;
  std::vector<Order> orders = {};
  std::size_t done = 0;  ///< of the orders
};

Comparison::~Comparison() = default;

std::vector<ResultRow> Comparison::run(std::size_t course, Query query, Truths& truths) {
  begin(course, query, truths);
  return end();
}

void Comparison::begin(std::size_t course, Query query) {
  Truths truths(oracle_, workload_.courses[course]);
  begin(course, query, truths);
}

void Comparison::begin(std::size_t course, Query query, Truths& truths) {
  auto begun = std::make_unique<Begun>(Begun{course, query, plan_for(course, truths)});
  const std::string& trajectory = workload_.trajectories[course];
  for (std::size_t i = 0; i < processes_.size(); ++i) {
    const std::string contestant = processes_[i].spec().text();
    if (!filter_(trajectory, contestant)) {
      left_out_.emplace_back(trajectory, contestant);
      continue;
    }
    begun->cases.emplace_back(workload_, stage_, effort_, processes_[i], course, query, begun->plan);
    begun->whose.push_back(i);
  }
  verify(*begun, truths);
  add_control(*begun, truths);
  begun->orders = orders_for(begun->together.size(), effort_, Random(seed_ + course));
  measure(*begun, begun->orders.size() / 2);
  begun_.push_back(std::move(begun));
}

void Comparison::verify(Begun& begun, Truths& truths) {
  for (std::size_t i = 0; i < begun.cases.size(); ++i) {
    Case& one = begun.cases[i];
    check_for_interrupt();
    progress_(workload_.trajectories[begun.course], one.contestant());
    one.introduce();
    verify(one, stored_by(begun.whose[i]), begun.course, truths);
    begun.together.push_back(&one);
    if (turns_ == Turns::together) continue;
    begun.orders = orders_for(begun.together.size(), effort_, Random(seed_ + begun.course));
    measure(begun, begun.orders.size());
    begun.done = 0;
    begun.together.clear();
    one.dismiss();
  }
}

void Comparison::add_control(Begun& begun, Truths& truths) {
  begun.controlled = to_control(begun.together);
  if (begun.controlled == nullptr) return;
  begun.control.emplace(workload_, stage_, effort_, *control_, begun.course, begun.query, begun.plan);
  begun.control->introduce_like(*begun.controlled);
  begun.control->verify(truths);
  begun.together.push_back(&*begun.control);
}

std::vector<ResultRow> Comparison::end() {
  Begun& begun = *begun_.front();
  measure(begun, begun.orders.size());
  std::vector<ResultRow> rows = rows_of(begun);
  begun_.pop_front();
  return rows;
}

std::vector<ResultRow> Comparison::so_far() {
  std::vector<ResultRow> rows;
  for (const std::unique_ptr<Begun>& begun : begun_) {
    for (Case& one : begun->cases) {
      ResultRow row = one.finish();
      if (row.throughput || row.status != "ok") rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<ResultRow> Comparison::rows_of(Begun& begun) {
  std::vector<ResultRow> rows;
  std::optional<Control> found;
  for (Case& one : begun.cases) {
    rows.push_back(one.finish());
    if (&one == begun.controlled) found = control_of(rows.back(), begun.control->finish());
  }
  if (effort_.repetitions > 0 && !rows.empty()) steadiness_.push_back(steadiness_of(rows, std::move(found)));
  return rows;
}

SamplePlan Comparison::plan_for(std::size_t course, Truths& truths) const {
  const std::vector<Step>& steps = workload_.courses[course];
  const std::vector<double> distances = truths.distances(telling_steps(steps.size()));
  return {steps.size(), phases_of(steps, distances, workload_.mesh.diagonal()), seed_ + course};
}

Case* Comparison::to_control(const std::vector<Case*>& cases) {
  if (effort_.repetitions == 0) return nullptr;
  Case* chosen = nullptr;
  for (Case* const one : cases) {
    if (!one->alive() || !one->claims_exactness()) continue;
    if (control_ && one->spec().text() == control_->spec().text()) return one;
    if (chosen == nullptr || one->calibrated_ns() < chosen->calibrated_ns()) chosen = one;
  }
  if (chosen == nullptr) return nullptr;
  const ContestantSpec& spec = chosen->spec();
  control_.emplace(stage_, spec, roster_.find(spec.name).worker_program(spec.values));
  return chosen;
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

void Comparison::measure(Begun& begun, std::size_t end) {
  if (effort_.repetitions == 0) return;
  for (; begun.done < end; ++begun.done) {
    const Order& order = begun.orders[begun.done];
    check_for_interrupt();
    Case& one = *begun.together[order.which];
    progress_(workload_.trajectories[begun.course], one.contestant());
    (one.*order.measurement)();
  }
}

}  // namespace touchmark::bench
