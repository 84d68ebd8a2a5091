#include "bench/ground_truth/scene_truths.h"

#include <limits>

#include "bench/oracle/judge.h"
#include "bench/support/system/interrupt.h"

namespace touchmark::bench::ground_truth {

oracle::SceneOracle scene_oracle(const scenes::PlacedScene& scene) {
  std::vector<oracle::SceneOracle::Body> bodies;
  for (const scenes::PlacedScene::PlacedBody& body : scene.bodies)
    bodies.push_back({body.shape, body.start, scene.radius_of(body.shape)});
  return {scene.shapes, std::move(bodies)};
}

SceneTruths::~SceneTruths() {
  follower_.stand_at(
      nullptr, 0, [&](std::uint32_t body, const Pose& pose) { oracle_.place(body, pose); },
      [&](std::uint32_t body) { return scene_.bodies[body].start; });
}

void SceneTruths::stand_at(std::size_t step) {
  follower_.stand_at(
      &schedule_, step, [&](std::uint32_t body, const Pose& pose) { oracle_.place(body, pose); },
      [&](std::uint32_t body) { return scene_.bodies[body].start; });
}

Sweep SceneTruths::sweep_of(std::size_t step) const {
  const Probe& now = steps_[step].probe;
  return {steps_[step > 0 ? step - 1 : 0].probe.center, now.center, now.radius};
}

const oracle::GroundTruth& SceneTruths::position(std::size_t step) {
  if (!positions_[step]) positions_[step] = oracle_.solve(steps_[step].probe.center);
  return *positions_[step];
}

const oracle::SweepGroundTruth& SceneTruths::sweep(std::size_t step) {
  if (!sweeps_[step]) sweeps_[step] = oracle::truth_of_sweep(oracle_, sweep_of(step));
  return *sweeps_[step];
}

std::vector<double> SceneTruths::distances(const std::vector<std::size_t>& steps) {
  std::vector<double> distances;
  for (const std::size_t step : steps) {
    support::check_for_interrupt();
    stand_at(step);
    const oracle::GroundTruth& truth = position(step);
    distances.push_back(truth.defined ? truth.high : std::numeric_limits<double>::infinity());
  }
  return distances;
}

oracle::ErrorCounts SceneTruths::judge(workload::Query query, const std::vector<workload::StepRange>& ranges,
                                       std::span<const workload::Answer> answers, const Accuracy& accuracy,
                                       const oracle::Reported& reported, std::vector<WrongAnswer>* wrong,
                                       std::vector<oracle::Charge>* charges) {
  oracle::ErrorCounts counts;
  if (wrong != nullptr) wrong->clear();
  std::size_t done = 0;
  for (const workload::StepRange& range : ranges) {
    for (std::size_t step = range.begin; step < range.end; ++step, ++done) {
      support::check_for_interrupt();
      stand_at(step);
      const workload::Answer& answer = answers[done];
      const oracle::ErrorCounts one =
          query == workload::Query::sweep
              ? oracle::judge_one(oracle_, sweep(step), sweep_of(step), answer, accuracy, reported)
              : oracle::judge_one(oracle_, position(step), query, steps_[step].probe, steps_[step].reach,
                                  answer, accuracy, reported);
      if (one.charged() && charges != nullptr) charges->push_back({done, one});
      if (one.charged() && wrong != nullptr && wrong->size() < wrong_answers_kept)
        wrong->push_back(wrong_answer(query, step, answer, one));
      counts += one;
    }
  }
  return counts;
}

std::vector<StepTruth> SceneTruths::known(workload::Query query) const {
  std::vector<StepTruth> steps(steps_.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    StepTruth& step = steps[i];
    if (query == workload::Query::sweep) {
      step.known = sweeps_[i].has_value();
      step.found = step.known && sweeps_[i]->hit;
      continue;
    }
    step.known = positions_[i].has_value();
    if (!step.known) continue;
    const oracle::GroundTruth& truth = *positions_[i];
    const Probe& probe = steps_[i].probe;
    step.found = oracle_.within(truth, probe.center,
                                query == workload::Query::touches ? probe.radius : steps_[i].reach);
    step.distance = truth.defined ? truth.high : std::numeric_limits<double>::infinity();
    step.point = truth.point;
    if (truth.defined) step.triangle = oracle_.name_of(truth.triangle).second;
  }
  return steps;
}

WrongAnswer SceneTruths::wrong_answer(workload::Query query, std::size_t step, const workload::Answer& got,
                                      const oracle::ErrorCounts& charged) {
  WrongAnswer wrong;
  wrong.step = step;
  wrong.query = query;
  wrong.asked = steps_[step];
  wrong.got = got;
  wrong.charged = charged;
  if (query == workload::Query::sweep) {
    const Sweep way = sweep_of(step);
    wrong.from = way.from;
    wrong.found = sweep(step).hit;
    if (got.found != 0) wrong.truth = oracle_.solve(Vec3(way.from + got.fraction * (way.to - way.from)));
  } else {
    wrong.truth = position(step);
    const Probe& probe = wrong.asked.probe;
    const double limit = query == workload::Query::touches ? probe.radius : wrong.asked.reach;
    wrong.found = oracle_.within(wrong.truth, probe.center, limit);
  }
  wrong.body = 0;
  if (wrong.truth.defined) {
    const auto [body, triangle] = oracle_.name_of(wrong.truth.triangle);
    wrong.body = body;
    wrong.triangle = triangle;
  }
  return wrong;
}

}  // namespace touchmark::bench::ground_truth
