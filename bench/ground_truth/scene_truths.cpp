#include "bench/ground_truth/scene_truths.h"

#include "bench/oracle/judge.h"
#include "bench/oracle/moving_judge.h"
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

const oracle::GroundTruth& SceneTruths::position(std::size_t step) {
  if (!positions_.known[step]) positions_.set(step, oracle_.solve(steps_[step].probe.center));
  return positions_.truths[step];
}

const oracle::SweepGroundTruth& SceneTruths::sweep(std::size_t step) {
  if (!sweeps_.known[step]) sweeps_.set(step, oracle::truth_of_sweep(oracle_, sweep_of(step)));
  return sweeps_.truths[step];
}

std::vector<double> SceneTruths::distances(const std::vector<std::size_t>& steps) {
  std::vector<double> distances;
  for (const std::size_t step : steps) {
    support::check_for_interrupt();
    stand_at(step);
    distances.push_back(distance_of(position(step)));
  }
  return distances;
}

oracle::ErrorCounts SceneTruths::judge_moving(std::size_t step, const workload::Answer& answer) {
  stand_at(step > 0 ? step - 1 : 0);
  std::vector<oracle::BodyScrew> screws;
  for (std::uint32_t body = 0; body < scene_.bodies.size(); ++body)
    screws.emplace_back(body, oracle_.pose(body));
  stand_at(step);
  std::erase_if(screws, [&](oracle::BodyScrew& screw) { return !screw.goes_to(oracle_.pose(screw.body())); });
  return oracle::judge_moving(oracle_, screws, sweep_of(step), answer);
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
          query == workload::Query::moving ? judge_moving(step, answer)
          : query == workload::Query::sweep
              ? oracle::judge_one(oracle_, sweep(step), sweep_of(step), answer, accuracy, reported)
              : oracle::judge_one(oracle_, position(step), query, steps_[step].probe, steps_[step].reach,
                                  answer, accuracy, reported);
      if (one.charged() && charges != nullptr) charges->push_back({done, one});
      if (one.charged() && wrong != nullptr && wrong->size() < wrong_answers_kept) {
        WrongAnswer& added = wrong->emplace_back(wrong_answer(query, step, answer, one));
        added.body = added.truth.defined ? oracle_.name_of(added.truth.triangle).first : 0;
      }
      counts += one;
    }
  }
  return counts;
}

}  // namespace touchmark::bench::ground_truth
