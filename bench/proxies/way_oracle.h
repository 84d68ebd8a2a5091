/// What is true of a proxy's way: exact, by the oracle's box tree, intervals and integers, and by nothing of
/// core/geometry.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "bench/oracle/oracle.h"
#include "bench/oracle/scene_oracle.h"
#include "bench/scenes/schedule.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::proxies {

class WayOracle {
 public:
  explicit WayOracle(const TriangleMesh& mesh);
  /// Knows bodies as they stand at the first step of a schedule, whose moves must outlive it.
  WayOracle(scenes::PlacedScene scene, scenes::ScheduleView schedule);
  WayOracle(const WayOracle&) = delete;
  WayOracle& operator=(const WayOracle&) = delete;

  /// Returns true if the segment and a triangle have a point in common, sides, corners and ends included.
  bool meets(const Vec3& from, const Vec3& to) const { return reference().segment_within(from, to, 0); }
  /// Returns true if the segment comes within the radius: at most so near.
  bool is_within(const Vec3& from, const Vec3& to, double radius) const {
    return reference().segment_within(from, to, radius);
  }
  /// Returns true if the segment comes nearer than the radius.
  bool is_nearer(const Vec3& from, const Vec3& to, double radius) const {
    return reference().segment_nearer(from, to, radius);
  }
  /// Returns true if the segment passes a triangle's inside with both ends and its sides at least `margin`
  /// away: no rounding explains it.
  bool surely_crosses(const Vec3& from, const Vec3& to, double margin) const {
    return reference().surely_crosses(from, to, margin);
  }
  /// How much nearer to the surface than the radius the position is; 0 where it is not. Rounded.
  double shortfall(const Vec3& at, double radius) const;
  /// The side of a closed mesh; nothing where it is not closed, and among bodies.
  std::optional<Side> side(const Vec3& at) const { return reference().side(at); }

  /// The nearest place of the mesh, and a unit vector from there away from the mesh, over the position where
  /// that is outside or not known to be inside.
  struct WayOut {
    Vec3 from, direction;
  };
  WayOut way_out(const Vec3& at) const;

  double diagonal() const { return diagonal_; }

  /// Moves bodies to where they are at a step of their schedule.
  void stand_at(std::size_t step);

 private:
  struct Bodies {
    scenes::PlacedScene scene;
    oracle::SceneOracle oracle;
    scenes::ScheduleView schedule;
    scenes::ScheduleFollower follower = {};
  };
  const oracle::Reference& reference() const {
    return bodies_ ? static_cast<const oracle::Reference&>(bodies_->oracle) : *oracle_;
  }

  std::optional<TriangleMesh> mesh_;  ///< as `oracle_` alone there
  std::optional<oracle::Oracle> oracle_;
  std::optional<Bodies> bodies_;
  double diagonal_;
};

/// Returns where a proxy that is to follow these goals, at least one, is free from the start: farther than
/// the radius from the mesh. That is the first goal that is free. Where none is, it is a place outward from
/// the first goal, as far as that takes: on the line from the nearest point of the mesh through the goal, or
/// from inside a closed mesh the other way.
Vec3 free_start(const WayOracle& oracle, std::span<const Vec3> goals, double radius);

}  // namespace touchmark::bench::proxies
