/// The judge of a sweep among bodies that move: both motions are replayed in steps so short that nothing is
/// passed.
#pragma once

#include <cstdint>
#include <span>

#include "bench/oracle/error_counts.h"
#include "bench/oracle/scene_oracle.h"
#include "bench/workload/answer.h"
#include "core/probe.h"
#include "core/scene/pose.h"

namespace touchmark::bench::oracle {

/// A body's way along the screw between two poses, in extended precision by its axis.
class BodyScrew {
 public:
  BodyScrew(std::uint32_t body, const Pose& before) : body_(body), before_(before), after_(before) {}
  /// Sets where it ends. Returns false if that is where it begins.
  bool goes_to(const Pose& after);

  std::uint32_t body() const noexcept { return body_; }
  Pose at(double time) const;
  Vec3 velocity(const Vec3& point) const { return angle_ * axis_.cross(point - through_) + shift_; }

 private:
  std::uint32_t body_;
  Pose before_, after_;
  double angle_ = 0;
  Vec3 axis_ = Vec3::UnitZ(), through_ = Vec3::Zero(), shift_ = Vec3::Zero();
};

/// Judges whether the answer is late, or earlier than docs/exactness.md E33 allows. What is within rounding
/// of a touch is unresolved. The oracle's bodies stand at the end of their ways, before and after the call.
ErrorCounts judge_moving(SceneOracle& oracle, std::span<const BodyScrew> screws, const Sweep& sweep,
                         const workload::Answer& answer);

}  // namespace touchmark::bench::oracle
