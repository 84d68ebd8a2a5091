/// Random poses for the tests of scenes: the same on every machine.
#pragma once

#include "bench/support/random.h"
#include "core/scene/pose.h"

namespace touchmark::test {

using bench::support::Random;

/// Turned anyhow about this position.
inline Pose random_pose(Random& random, const Vec3& position) {
  const double w = random.between(-1, 1), x = random.between(-1, 1), y = random.between(-1, 1);
  return pose_of(position, w, x, y, random.between(-1, 1) + 1e-3);
}

}  // namespace touchmark::test
