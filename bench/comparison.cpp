#include "bench/comparison.h"

#include <utility>

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

}  // namespace

Comparison::Comparison(const Roster& roster, const Workload& workload,
                       const std::vector<ContestantSpec>& contestants, const WorkerOptions& workers,
                       const Effort& effort, std::uint64_t seed)
    : workload_(workload), effort_(effort), seed_(seed), stage_(workload, workers), oracle_(workload.mesh) {
  for (const ContestantSpec& spec : contestants) {
    processes_.emplace_back(stage_, spec, roster.find(spec.name).worker_program(spec.values));
  }
}

void Comparison::skip(const ContestantSpec& spec, const std::string& status) {
  for (ContestantProcess& process : processes_) {
    if (process.spec().text() == spec.text()) process.give_up(status);
  }
}

std::vector<ResultRow> Comparison::run(std::size_t course, Query query) {
  const std::string& trajectory = workload_.trajectories[course];
  std::deque<Case> cases;
  for (ContestantProcess& process : processes_) {
    if (filter_(trajectory, process.spec().text())) {
      cases.emplace_back(workload_, stage_, effort_, process, course, query);
    }
  }
  Truths truths(oracle_, Course{query, workload_.courses[course]});
  std::vector<Case*> together;
  for (Case& one : cases) {
    verify(one, truths, trajectory);
    if (turns_ == Turns::together) {
      together.push_back(&one);
    } else {
      measure({&one}, trajectory, seed_ + course);
      one.dismiss();
    }
  }
  measure(together, trajectory, seed_ + course);
  std::vector<ResultRow> rows;
  for (Case& one : cases) rows.push_back(one.finish());
  return rows;
}

void Comparison::verify(Case& one, Truths& truths, const std::string& trajectory) {
  check_for_interrupt();
  progress_(trajectory, one.contestant());
  one.introduce();
  one.verify(truths);
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
