/// The ground truth about the steps of one trace over a scene of bodies, each step where the bodies are then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bench/ground_truth/ground_truth.h"
#include "bench/oracle/scene_oracle.h"
#include "bench/scenes/schedule.h"
#include "bench/workload/steps.h"

namespace touchmark::bench::ground_truth {

/// The oracle's bodies where they are at the start.
oracle::SceneOracle scene_oracle(const scenes::PlacedScene& scene);

class SceneTruths final : public TraceTruths {
 public:
  /// All must outlive it. It moves the oracle's bodies, so one at a time may use the oracle.
  SceneTruths(oracle::SceneOracle& oracle, const scenes::PlacedScene& scene, scenes::ScheduleView schedule,
              std::span<const workload::Step> steps)
      : oracle_(oracle),
        scene_(scene),
        schedule_(schedule),
        steps_(steps),
        positions_(steps.size()),
        sweeps_(steps.size()) {}
  SceneTruths(const SceneTruths&) = delete;
  /// Puts the bodies back where they were.
  ~SceneTruths() override;

  using TraceTruths::judge;
  oracle::ErrorCounts judge(workload::Query query, const std::vector<workload::StepRange>& ranges,
                            std::span<const workload::Answer> answers, const Accuracy& accuracy,
                            const oracle::Reported& reported, std::vector<WrongAnswer>* wrong,
                            std::vector<oracle::Charge>* charges) override;
  std::vector<StepTruth> known(workload::Query query) const override;
  std::vector<double> distances(const std::vector<std::size_t>& steps) override;

 private:
  void stand_at(std::size_t step);
  Sweep sweep_of(std::size_t step) const;
  const oracle::GroundTruth& position(std::size_t step);
  const oracle::SweepGroundTruth& sweep(std::size_t step);
  WrongAnswer wrong_answer(workload::Query query, std::size_t step, const workload::Answer& got,
                           const oracle::ErrorCounts& charged);

  oracle::SceneOracle& oracle_;
  const scenes::PlacedScene& scene_;
  scenes::ScheduleView schedule_;
  std::span<const workload::Step> steps_;
  scenes::ScheduleFollower follower_;
  std::vector<std::optional<oracle::GroundTruth>> positions_;  ///< what is known so far, one a step
  std::vector<std::optional<oracle::SweepGroundTruth>> sweeps_;
};

}  // namespace touchmark::bench::ground_truth
