/// The ground truth about the steps of one trace over a scene of bodies, each step where the bodies are then.
#pragma once

#include <cstddef>
#include <cstdint>
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
  /// All but the steps must outlive it. It moves the oracle's bodies, so one at a time may use the oracle.
  SceneTruths(oracle::SceneOracle& oracle, const scenes::PlacedScene& scene, scenes::ScheduleView schedule,
              std::span<const workload::Step> steps)
      : TraceTruths(steps), oracle_(oracle), scene_(scene), schedule_(schedule) {}
  SceneTruths(const SceneTruths&) = delete;
  /// Puts the bodies back where they were.
  ~SceneTruths() override;

  using TraceTruths::judge;
  oracle::ErrorCounts judge(workload::Query query, const std::vector<workload::StepRange>& ranges,
                            std::span<const workload::Answer> answers, const Accuracy& accuracy,
                            const oracle::Reported& reported, std::vector<WrongAnswer>* wrong,
                            std::vector<oracle::Charge>* charges) override;
  std::vector<double> distances(const std::vector<std::size_t>& steps) override;

 private:
  void stand_at(std::size_t step);
  /// Judges an answer about the way of probe and bodies from the step before.
  oracle::ErrorCounts judge_moving(std::size_t step, const workload::Answer& answer);
  const oracle::GroundTruth& position(std::size_t step);
  const oracle::SweepGroundTruth& sweep(std::size_t step);
  const oracle::Reference& reference() const override { return oracle_; }
  TriangleId id_of(std::uint32_t triangle) const override { return oracle_.name_of(triangle).second; }

  oracle::SceneOracle& oracle_;
  const scenes::PlacedScene& scene_;
  scenes::ScheduleView schedule_;
  scenes::ScheduleFollower follower_;
};

}  // namespace touchmark::bench::ground_truth
