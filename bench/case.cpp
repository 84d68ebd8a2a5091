#include "bench/case.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "bench/median.h"
#include "bench/windows.h"

namespace touchmark::bench {
namespace {

double median_absolute_deviation(std::vector<double> values) {
  const double center = median(values);
  for (double& value : values) value = std::abs(value - center);
  return median(values);
}

double largest_radius(const std::vector<Step>& course) {
  double largest = 0;
  for (const Step& step : course) largest = std::max(largest, step.probe.radius);
  return largest;
}

double largest_reach(const std::vector<Step>& course) {
  double largest = 0;
  for (const Step& step : course) largest = std::max(largest, step.reach);
  return largest;
}

}  // namespace

Case::Case(const Workload& workload, const WorkerStage& stage, const Effort& effort,
           ContestantProcess& process, std::size_t course, Query query)
    : stage_(stage),
      effort_(effort),
      process_(process),
      task_{course, query, 1},
      course_steps_(workload.courses[course].size()) {
  row_.detector = process.spec().name;
  row_.options = process.spec().options;
  row_.mesh = workload.mesh_name;
  row_.triangles = workload.mesh.size();
  row_.trajectory = workload.trajectories[course];
  row_.query = query;
  row_.radius = largest_radius(workload.courses[course]);
  row_.reach = largest_reach(workload.courses[course]);
}

/// A worker that fails gives the row its status.
template <class Action>
void Case::attempt(Action action) {
  if (!alive()) return;
  try {
    action();
  } catch (const WorkerFailure& failure) {
    row_.status = failure.what();
  }
}

void Case::introduce() {
  attempt([&] {
    const Built& built = process_.build();
    row_.accuracy = built.accuracy;
    row_.build_ms = built.build_ms;
    row_.bytes = built.bytes;
    row_.heap_bytes = built.heap_bytes;
    if (std::find(built.queries.begin(), built.queries.end(), task_.query) == built.queries.end()) {
      row_.status = "unsupported";
      return;
    }
    process_.unmake();
    row_.first_answer_ms = built.build_ms + process_.first(task_).ns_per_query / 1e6;
    const double ns = std::max(process_.calibrate(task_, effort_.pass_budget_ns / 4).ns_per_query, 1.0);
    task_.steps = static_cast<std::size_t>(
        std::clamp(effort_.pass_budget_ns / ns, 1.0, static_cast<double>(course_steps_)));
    windows_ = plan_windows(course_steps_, task_.steps);
    row_.steps = steps_in(windows_);
    const double pass_ns = ns * static_cast<double>(row_.steps);
    passes_ = static_cast<std::int64_t>(std::max(effort_.repetition_ns / pass_ns, 1.0));
  });
}

void Case::verify(Truths& truths, Truths* stored) {
  attempt([&] {
    process_.unmake();
    const Answered answered = process_.answer(task_);
    row_.checksum = answered.checksum;
    row_.work = summarize_work(stage_.room().work(row_.steps), answered.work);
  });
  if (alive()) judge(truths, stored);
}

void Case::judge(Truths& truths, Truths* stored) {
  const std::span<const Answer> answers = stage_.room().answers(row_.steps);
  Checksum checksum;
  for (const Answer& answer : answers) checksum.add(answer);
  if (checksum.value() != row_.checksum) {
    row_.status = "checksum mismatch";
    return;
  }
  row_.tally = truths.judge(task_.query, windows_, answers, *row_.accuracy);
  if (stored != nullptr) row_.stored_tally = stored->judge(task_.query, windows_, answers, *row_.accuracy);
}

void Case::expect_verified_answers(const Timed& timed) {
  if (!timed.steady || timed.checksum != row_.checksum) row_.status = "checksum mismatch";
}

void Case::first_pass() {
  attempt([&] {
    process_.unmake();
    const Timed timed = process_.first_pass(task_);
    first_pass_ns_ = timed.ns_per_query;
    expect_verified_answers(timed);
  });
}

void Case::repetition() {
  attempt([&] {
    const Timed timed = process_.time(task_, passes_);
    repetitions_ns_.push_back(timed.ns_per_query);
    repetitions_cpu_ns_.push_back(timed.cpu_ns_per_query);
    expect_verified_answers(timed);
  });
}

void Case::latency_pass() {
  attempt([&] {
    const Timed timed = process_.latency(task_);
    expect_verified_answers(timed);
    latencies_ns_.push_back(in_ns(stage_.room().ticks(row_.steps)));
    if (process_.build().prepares) prepared_ns_.push_back(in_ns(stage_.room().prepare_ticks(row_.steps)));
  });
}

std::vector<double> Case::in_ns(std::span<const std::uint64_t> ticks) const {
  std::vector<double> ns;
  ns.reserve(ticks.size());
  for (const std::uint64_t step : ticks) {
    ns.push_back(static_cast<double>(step) * process_.opened().ns_per_tick);
  }
  return ns;
}

void Case::dismiss() { process_.end(); }

ResultRow Case::finish() {
  // What was timed before things went wrong is not a result.
  if (!alive() || repetitions_ns_.empty()) return row_;
  row_.throughput = ThroughputResult{median(repetitions_ns_),
                                     *std::min_element(repetitions_ns_.begin(), repetitions_ns_.end()),
                                     median_absolute_deviation(repetitions_ns_),
                                     first_pass_ns_,
                                     median(repetitions_cpu_ns_),
                                     repetitions_ns_.size()};
  if (!latencies_ns_.empty()) row_.latency = summarize_latency(median_per_step(latencies_ns_), windows_);
  if (!prepared_ns_.empty()) row_.prepare = summarize_latency(median_per_step(prepared_ns_), windows_);
  row_.clock_cost_ns = process_.opened().clock_cost_ns;
  return row_;
}

}  // namespace touchmark::bench
