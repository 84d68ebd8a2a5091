/// A motion that is written down tick by tick until it has as many positions as were asked for.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/probe.h"

namespace touchmark::bench::trajectories {

class Path {
 public:
  explicit Path(std::size_t steps) : steps_(steps) { positions_.reserve(steps); }

  bool full() const { return positions_.size() >= steps_; }
  /// 0 before the first position.
  double distance_to(const Vec3& target) const {
    return positions_.empty() ? 0 : (target - positions_.back()).norm();
  }

  /// To the target in `ticks` positions, from rest to rest, at most 1.5 times the mean speed. A path begins
  /// at its first target.
  void go(const Vec3& target, std::size_t ticks) {
    if (positions_.empty()) return add(target);
    const Vec3 from = positions_.back();
    for (std::size_t i = 1; i < ticks && !full(); ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(ticks);
      add(from + t * t * (3 - 2 * t) * (target - from));
    }
    add(target);
  }

  /// Towards the target in straight steps of `speed`; the way left over is made up at the start of the next
  /// flight, so that the ticks fall anywhere along it.
  void fly(const Vec3& target, double speed) {
    if (positions_.empty()) {
      corner_ = target;
      return add(target);
    }
    const Vec3 from = corner_;
    const double length = (target - from).norm();
    double at = speed - left_over_;
    for (; at <= length && !full(); at += speed) add(from + at / length * (target - from));
    left_over_ = length - (at - speed);
    corner_ = target;
  }

  std::vector<Vec3> positions() && { return std::move(positions_); }

 private:
  void add(const Vec3& position) {
    if (!full()) positions_.push_back(position);
  }

  std::size_t steps_;
  std::vector<Vec3> positions_;
  Vec3 corner_ = Vec3::Zero();  ///< the last flight's target
  double left_over_ = 0;        ///< from the last position to there
};

}  // namespace touchmark::bench::trajectories
