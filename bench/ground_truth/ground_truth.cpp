#include "bench/ground_truth/ground_truth.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "bench/support/system/interrupt.h"
#include "bench/workload/sample_steps.h"

namespace touchmark::bench::ground_truth {
namespace {

/// Often enough for Ctrl-C, seldom enough for threads to be worth starting.
constexpr std::size_t solved_at_once = 2048;

}  // namespace

Sweep TraceTruths::sweep_of(std::size_t step) const {
  const Probe& now = steps_[step].probe;
  return {steps_[step > 0 ? step - 1 : 0].probe.center, now.center, now.radius};
}

double TraceTruths::distance_of(const oracle::GroundTruth& truth) noexcept {
  return truth.defined ? truth.high : std::numeric_limits<double>::infinity();
}

bool TraceTruths::is_found(workload::Query query, std::size_t step) const {
  if (query == workload::Query::sweep) return sweeps_.truths[step].hit;
  const workload::Step& asked = steps_[step];
  return reference().within(positions_.truths[step], asked.probe.center,
                            query == workload::Query::touches ? asked.probe.radius : asked.reach);
}

std::vector<StepTruth> TraceTruths::known(workload::Query query) const {
  const bool sweeps = query == workload::Query::sweep;
  std::vector<StepTruth> steps(steps_.size());
  if (query == workload::Query::moving) return steps;  // each answer is judged by itself
  for (std::size_t i = 0; i < steps.size(); ++i) {
    StepTruth& step = steps[i];
    step.known = sweeps ? sweeps_.known[i] : positions_.known[i];
    if (!step.known) continue;
    step.found = is_found(query, i);
    if (sweeps) continue;
    const oracle::GroundTruth& truth = positions_.truths[i];
    step.distance = distance_of(truth);
    step.point = truth.point;
    if (truth.defined) step.triangle = id_of(truth.triangle);
  }
  return steps;
}

WrongAnswer TraceTruths::wrong_answer(workload::Query query, std::size_t step, const workload::Answer& got,
                                      const oracle::ErrorCounts& charged) const {
  WrongAnswer wrong;
  wrong.step = step;
  wrong.query = query;
  wrong.asked = steps_[step];
  wrong.found = query == workload::Query::moving ? charged.missed > 0 : is_found(query, step);
  wrong.got = got;
  wrong.charged = charged;
  if (workload::is_of_a_way(query)) {
    const Sweep sweep = sweep_of(step);
    wrong.from = sweep.from;
    if (got.found != 0)
      wrong.truth = reference().solve(Vec3(sweep.from + got.fraction * (sweep.to - sweep.from)));
  } else {
    wrong.truth = positions_.truths[step];
    if (charged.wrong_side > 0) wrong.side = reference().side(wrong.asked.probe.center);
  }
  if (wrong.truth.defined) wrong.triangle = id_of(wrong.truth.triangle);
  return wrong;
}

template <class Truth, class Question>
void GroundTruths::solve(const std::vector<workload::StepRange>& ranges, Solved<Truth>& solved,
                         const Question& question) {
  std::vector<std::size_t> unknown;
  for (const workload::StepRange& range : ranges)
    for (std::size_t i = range.begin; i < range.end; ++i)
      if (!solved.known[i]) unknown.push_back(i);
  for (std::size_t begin = 0; begin < unknown.size(); begin += solved_at_once) {
    support::check_for_interrupt();
    const std::span<const std::size_t> some =
        std::span(unknown).subspan(begin, std::min(solved_at_once, unknown.size() - begin));
    std::vector<decltype(question(begin))> wanted;
    for (const std::size_t i : some) wanted.push_back(question(i));
    const std::vector<Truth> truths = oracle_.solve(std::span(std::as_const(wanted)));
    for (std::size_t i = 0; i < some.size(); ++i) solved.set(some[i], truths[i]);
  }
}

void GroundTruths::solve_positions(const std::vector<workload::StepRange>& ranges) {
  solve(ranges, positions_, [&](std::size_t step) { return steps_[step].probe; });
}

std::vector<double> GroundTruths::distances(const std::vector<std::size_t>& steps) {
  std::vector<workload::StepRange> ranges;
  for (const std::size_t step : steps) ranges.push_back({step, step + 1});
  solve_positions(workload::joined(ranges));
  std::vector<double> distances;
  for (const std::size_t step : steps) distances.push_back(distance_of(positions_.truths[step]));
  return distances;
}

oracle::ErrorCounts GroundTruths::judge(workload::Query query, const std::vector<workload::StepRange>& ranges,
                                        std::span<const workload::Answer> answers, const Accuracy& accuracy,
                                        const oracle::Reported& reported, std::vector<WrongAnswer>* wrong,
                                        std::vector<oracle::Charge>* all_charges) {
  if (query == workload::Query::sweep)
    solve(ranges, sweeps_, [&](std::size_t step) { return sweep_of(step); });
  else
    solve_positions(ranges);
  oracle::ErrorCounts counts;
  if (wrong != nullptr) wrong->clear();
  const std::size_t kept =
      all_charges != nullptr ? std::numeric_limits<std::size_t>::max() : wrong_answers_kept;
  std::size_t done = 0;
  for (const workload::StepRange& range : ranges) {
    support::check_for_interrupt();
    oracle::Charges charges(kept);
    counts += judge(query, range, answers.subspan(done, range.size()), accuracy, reported, charges);
    for (const oracle::Charge& one : charges.kept()) {
      if (all_charges != nullptr) all_charges->push_back({done + one.step, one.counts});
      if (wrong == nullptr || wrong->size() == wrong_answers_kept) continue;
      wrong->push_back(wrong_answer(query, range.begin + one.step, answers[done + one.step], one.counts));
    }
    done += range.size();
  }
  return counts;
}

oracle::ErrorCounts GroundTruths::judge(workload::Query query, workload::StepRange range,
                                        std::span<const workload::Answer> answers, const Accuracy& accuracy,
                                        const oracle::Reported& reported, oracle::Charges& charges) const {
  if (query == workload::Query::sweep) {
    std::vector<Sweep> sweeps;
    for (std::size_t step = range.begin; step < range.end; ++step) sweeps.push_back(sweep_of(step));
    return oracle::judge(oracle_, std::span(sweeps_.truths).subspan(range.begin, range.size()), sweeps,
                         answers, accuracy, reported, &charges);
  }
  // The judge takes one reach; recorded trajectories may change theirs from step to step.
  oracle::ErrorCounts counts;
  for (std::size_t begin = range.begin, end = begin; begin < range.end; begin = end) {
    const double reach = steps_[begin].reach;
    std::vector<Probe> probes;
    while (end < range.end && steps_[end].reach == reach) probes.push_back(steps_[end++].probe);
    // A reach that is not a number equals nothing.
    if (end == begin) probes.push_back(steps_[end++].probe);
    oracle::Charges of_this_reach(charges.max());
    counts +=
        oracle::judge(oracle_, std::span(positions_.truths).subspan(begin, end - begin), query, probes, reach,
                      answers.subspan(begin - range.begin, end - begin), accuracy, reported, &of_this_reach);
    charges.merge(of_this_reach, begin - range.begin);
  }
  return counts;
}

}  // namespace touchmark::bench::ground_truth
