#include "bench/ground_truth/ground_truth.h"

#include <algorithm>
#include <limits>

#include "bench/support/system/interrupt.h"
#include "bench/workload/sample_steps.h"

namespace touchmark::bench::ground_truth {
namespace {

/// Often enough for Ctrl-C, seldom enough for threads to be worth starting.
constexpr std::size_t solved_at_once = 2048;

}  // namespace

GroundTruths::GroundTruths(const oracle::Oracle& oracle, std::span<const workload::Step> steps)
    : oracle_(oracle) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Probe& now = steps[i].probe;
    probes_.questions.push_back(now);
    reaches_.push_back(steps[i].reach);
    sweeps_.questions.push_back({steps[i > 0 ? i - 1 : 0].probe.center, now.center, now.radius});
  }
}

template <class Question, class TruthType>
void GroundTruths::Asked<Question, TruthType>::solve(const oracle::Oracle& oracle,
                                                     const std::vector<workload::StepRange>& ranges) {
  truths.resize(questions.size());
  known.resize(questions.size());
  std::vector<std::size_t> unknown;
  for (const workload::StepRange& range : ranges) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (!known[i]) unknown.push_back(i);
    }
  }
  for (std::size_t begin = 0; begin < unknown.size(); begin += solved_at_once) {
    support::check_for_interrupt();
    const std::span<const std::size_t> some =
        std::span(unknown).subspan(begin, std::min(solved_at_once, unknown.size() - begin));
    std::vector<Question> wanted;
    for (const std::size_t i : some) wanted.push_back(questions[i]);
    const std::vector<TruthType> solved = oracle.solve(std::span<const Question>(wanted));
    for (std::size_t i = 0; i < some.size(); ++i) {
      truths[some[i]] = solved[i];
      known[some[i]] = true;
    }
  }
}

std::vector<double> GroundTruths::distances(const std::vector<std::size_t>& steps) {
  std::vector<workload::StepRange> ranges;
  for (const std::size_t step : steps) ranges.push_back({step, step + 1});
  probes_.solve(oracle_, workload::joined(ranges));
  std::vector<double> distances;
  for (const std::size_t step : steps) {
    const oracle::GroundTruth& truth = probes_.truths[step];
    distances.push_back(truth.defined ? truth.high : std::numeric_limits<double>::infinity());
  }
  return distances;
}

oracle::ErrorCounts GroundTruths::judge(workload::Query query, const std::vector<workload::StepRange>& ranges,
                                        std::span<const workload::Answer> answers, const Accuracy& accuracy,
                                        const oracle::Reported& reported, std::vector<WrongAnswer>* wrong,
                                        std::vector<oracle::Charge>* all_charges) {
  query == workload::Query::sweep ? sweeps_.solve(oracle_, ranges) : probes_.solve(oracle_, ranges);
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

std::vector<StepTruth> GroundTruths::known(workload::Query query) const {
  const bool sweeps = query == workload::Query::sweep;
  std::vector<StepTruth> steps(reaches_.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    StepTruth& step = steps[i];
    if (sweeps) {
      step.known = i < sweeps_.known.size() && sweeps_.known[i];
      step.found = step.known && sweeps_.truths[i].hit;
      continue;
    }
    step.known = i < probes_.known.size() && probes_.known[i];
    if (!step.known) continue;
    const oracle::GroundTruth& truth = probes_.truths[i];
    const Probe& probe = probes_.questions[i];
    step.found =
        oracle_.within(truth, probe.center, query == workload::Query::touches ? probe.radius : reaches_[i]);
    step.distance = truth.defined ? truth.high : std::numeric_limits<double>::infinity();
    step.point = truth.point;
    if (truth.defined) step.triangle = oracle_.mesh().id(truth.triangle);
  }
  return steps;
}

WrongAnswer GroundTruths::wrong_answer(workload::Query query, std::size_t step, const workload::Answer& got,
                                       const oracle::ErrorCounts& charged) const {
  WrongAnswer wrong;
  wrong.step = step;
  wrong.query = query;
  wrong.asked = {probes_.questions[step], reaches_[step]};
  wrong.got = got;
  wrong.charged = charged;
  if (query == workload::Query::sweep) {
    const Sweep& sweep = sweeps_.questions[step];
    wrong.from = sweep.from;
    wrong.found = sweeps_.truths[step].hit;
    if (got.found != 0)
      wrong.truth = oracle_.solve(Vec3(sweep.from + got.fraction * (sweep.to - sweep.from)));
  } else {
    wrong.truth = probes_.truths[step];
    const Vec3& center = wrong.asked.probe.center;
    wrong.found = oracle_.within(
        wrong.truth, center, query == workload::Query::touches ? wrong.asked.probe.radius : reaches_[step]);
    if (charged.wrong_side > 0) wrong.side = oracle_.side(center);
  }
  if (wrong.truth.defined) wrong.triangle = oracle_.mesh().id(wrong.truth.triangle);
  return wrong;
}

oracle::ErrorCounts GroundTruths::judge(workload::Query query, workload::StepRange range,
                                        std::span<const workload::Answer> answers, const Accuracy& accuracy,
                                        const oracle::Reported& reported, oracle::Charges& charges) const {
  if (query == workload::Query::sweep) {
    return oracle::judge(oracle_, std::span(sweeps_.truths).subspan(range.begin, range.size()),
                         std::span(sweeps_.questions).subspan(range.begin, range.size()), answers, accuracy,
                         reported, &charges);
  }
  // The judge takes one reach; recorded trajectories may change theirs from step to step.
  oracle::ErrorCounts counts;
  for (std::size_t begin = range.begin, end = begin; begin < range.end; begin = end) {
    while (end < range.end && reaches_[end] == reaches_[begin]) ++end;
    if (end == begin) ++end;  // a reach that is not a number equals nothing
    oracle::Charges of_this_reach(charges.max());
    counts +=
        oracle::judge(oracle_, std::span(probes_.truths).subspan(begin, end - begin), query,
                      std::span(probes_.questions).subspan(begin, end - begin), reaches_[begin],
                      answers.subspan(begin - range.begin, end - begin), accuracy, reported, &of_this_reach);
    charges.merge(of_this_reach, begin - range.begin);
  }
  return counts;
}

}  // namespace touchmark::bench::ground_truth
