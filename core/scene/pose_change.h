/// What a body's next pose changes: how far its points move, and whether it is rigid as the one before.
#pragma once

#include "core/probe.h"
#include "core/scene/pose.h"
#include "core/simd/dispatch.h"

namespace touchmark {

/// A ball in a body's frame that holds its shape.
struct ShapeBall {
  Vec3 center = Vec3::Zero();
  double radius = 0;
  double center_size = 0;  ///< the sum of the centre's absolute coordinates
};

struct PoseChange {
  double rigid = 0;   ///< bounds what the new rotation is off orthonormal, as rigid_error does
  double motion = 0;  ///< bounds how far any point of the ball moves
  /// The pose is surely one that expect_rigid takes. Where it is false, that must be asked.
  bool is_rigid = false;
};

/// Takes a former pose that is rigid. All instructions give the same bits.
PoseChange pose_change(const Pose& from, const Pose& to, const ShapeBall& ball, Simd simd) noexcept;

}  // namespace touchmark
